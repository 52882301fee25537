// A wing, curved faces between sharp edges and flat caps, against a converged method of moments (tests/data/mom).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "smooth_bodies.h"
#include "solve/image.h"

namespace raytube {
namespace {

using namespace raytube::testing;

Target wing(double wavelength) { return Target(build_mesh(shapes::lens_wing(wavelength), 1.0).mesh); }

struct CutErrors {
  double vv, hh;  // rms dB within 20 dB of the peak
};

CutErrors errors_on_wing(const Target& target, const std::string& cut, bool waves) {
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/mom/wing3.csv");
  Sweep sweep{{10e9}, {}, true};
  std::vector<ScatteringMatrix> references;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.text(i, "cut") != cut) continue;
    sweep.looks.push_back({{table.number(i, "theta_i_deg") * degree, table.number(i, "phi_i_deg") * degree},
                           {table.number(i, "theta_deg") * degree, table.number(i, "phi_deg") * degree}});
    references.emplace_back().s = {{{table.complex(i, "vv"), 0.0}, {0.0, table.complex(i, "hh")}}};
  }
  SolveOptions options;
  options.surfaces.waves = waves;
  const SweepResult result = solve(target, sweep, options);
  std::array<double, 2> found{};
  for (int p = 0; p < 2; ++p) {
    double peak = 0.0;
    for (const ScatteringMatrix& s : references) peak = std::max(peak, std::abs(s.s[p][p]));
    std::vector<double> errors;
    for (std::size_t i = 0; i < references.size(); ++i)
      if (std::abs(references[i].s[p][p]) > 0.1 * peak)
        errors.push_back(dbsm(result.total[i].s[p][p]) - dbsm(references[i].s[p][p]));
    found[p] = rms(errors);
  }
  return {found[0], found[1]};
}

// Limits: what is left is waves over the tips and from the corners themselves, which nobody computes (the exact currents of an
// endless wing, cut off, leave 4.0 / 8.6, 12.8 / 5.8, 1.4 / .24 and 6.8 / 5.2 dB). Without waves from corner to corner along its
// edges: HH 5.4, 3.0 and 2.8 dB in the first two cuts and the last; without those over the surface, either, 4.5 / 7.1, 15.4
// / 4.6, 1.8 / .28 and 7.2 / 5.0 dB on all looks of the cuts.
TEST(Wing, AgainstTheMethodOfMoments) {
  struct Limit {
    const char* cut;
    double vv, hh;
  };
  const Target target = wing(speed_of_light / 10e9);
  for (const Limit& limit : {Limit{"az_th90", 0.7, 2.5}, Limit{"az_th75", 8.0, 2.2}, Limit{"el_ph0", 1.3, 0.3},
                             Limit{"bistatic_inc_th90_ph20", 5.0, 2.7}}) {
    const CutErrors with = errors_on_wing(target, limit.cut, true), without = errors_on_wing(target, limit.cut, false);
    measured((std::string("wing ") + limit.cut + ", VV").c_str(), with.vv, "dB");
    measured((std::string("wing ") + limit.cut + ", HH").c_str(), with.hh, "dB");
    EXPECT_LE(with.vv, limit.vv) << limit.cut;
    EXPECT_LE(with.hh, limit.hh) << limit.cut;
    EXPECT_LT(with.vv + with.hh, without.vv + without.hh) << limit.cut;
  }
}

// What waves start at the edges they reach is in images, too; nothing is left out: rounding of some thousand parts.
TEST(Wing, ImagesAddUp) {
  const Target target = wing(speed_of_light / 10e9);
  const Sweep sweep{{9e9, 10e9}, {{{70 * degree, 20 * degree}, {70 * degree, 20 * degree}}}};
  ScatteringMatrix sum;
  for (const ScatteringMatrix& cell : image_of_look(target, sweep, {}, 0, 5.0).cells) sum += cell;
  const ScatteringMatrix whole = solve(target, sweep, {}).total.back();
  EXPECT_LE(frobenius_norm(sum - whole), 1e-9 * frobenius_norm(whole));
}

}  // namespace
}  // namespace raytube
