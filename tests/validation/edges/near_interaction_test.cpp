// Edge-face interaction from and to antennas at a finite distance: full waves, the limit of plane waves, reciprocity.
#include <gtest/gtest.h>

#include "interaction_bodies.h"
#include "plan/phase_reference.h"
#include "solve/mechanisms/band_scene.h"
#include "validation/point_waves.h"

namespace raytube {
namespace {

using namespace point_waves;
using namespace testing;
using namespace testing::interaction;

/// A body whose interaction can be asked for by itself.
struct Body {
  explicit Body(PolygonSoup soup, std::vector<double> frequencies = {frequency})
      : mesh(build_mesh(std::move(soup), 1.0).mesh),
        target(mesh),
        sweep{std::move(frequencies), {{{1.0, 0.5}, {1.0, 0.5}}}, true},
        plan(target, sweep, adaptive(true)),
        curved_parts(find_curved_parts(target.mesh, target.options.min_wedge_angle)),
        band(plan, plan.bands.front(), curved_parts) {}

  double unit() const { return 4 * mesh.radius * mesh.radius / lambda; }  // D^2/lambda

  InteractionResult far(const Look& look) const { return band.edges.interaction(look, {1e-6 * lambda}); }
  InteractionResult near(const Look& look) const {
    const Radar radar;
    const AntennaPair pair(look, radar, mesh.center);
    const NearAntennas antennas{ImageAntenna(pair.transmit), &pair.receive};
    return band.edges.interaction(look, {1e-6 * lambda, &antennas});
  }

  TriangleMesh mesh;
  Target target;
  Sweep sweep;
  SolvePlan plan;
  CurvedParts curved_parts;
  BandScene band;
};

double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) { return frobenius_norm(a - b) / frobenius_norm(b); }

/// Phase and amplitude of the antennas at the origin taken out.
ScatteringMatrix referred(const Body& body, ScatteringMatrix s, const Look& near) {
  const Radar radar;
  return s *= from_plane_waves(body.mesh, near, radar, frequency);
}

// Of waves that bend by k a^2 / R = 1.6 D^2/lambda/R rad over the target as much must be off; what is left from afar are the
// rules of both ways to integrate, 1e-4 wavelengths.
TEST(NearInteraction, IsThatOfPlaneWavesFromAfar) {
  const Body bodies[] = {Body(shapes::dihedral(3 * lambda, 3 * lambda)), Body(square_trihedral(2 * lambda))};
  for (const Body& body : bodies)
    for (const Direction& direction : {Direction{80 * degree, 33 * degree}, Direction{63 * degree, 21 * degree}}) {
      const ScatteringMatrix limit = body.far({direction, direction}).scattering[0];
      for (const double units : {1e4, 1e7}) {
        const Look look = near_look(direction, units * body.unit());
        const double off = difference(body.near(look).scattering[0], referred(body, limit, look));
        EXPECT_LT(off, 1.6 / units + 2e-5);
      }
    }
}

// Where a solve takes the waves for plane ones they are those.
TEST(NearInteraction, OfASolveIsThatOfPlaneWavesFromAfar) {
  const Body body(shapes::dihedral(3 * lambda, 3 * lambda));
  SolveOptions options = adaptive(true);
  options.keep_parts = true;
  const Direction direction{80 * degree, 33 * degree};
  const auto part = [&](const Look& look) {
    return solve(body.target, {{frequency}, {look}, false}, options).of("interaction")[0];
  };
  const Look look = near_look(direction, 1e4 * body.unit());
  const double off = difference(part(look), part({direction, direction}));
  testing::measured("near interaction, dihedral at 1e4 D^2/lambda against the far field", off, "");
  EXPECT_LT(off, 2e-4);  // the solve's own bends: phases over the target are those of the antennas' ranges
}

struct NearCut {
  std::vector<ScatteringMatrix> reference, computed;
};

NearCut near_cut(const SolveOptions& options) {
  const std::string folder = RAYTUBE_SOURCE_DIR "/tests/data/mom/";
  const Table table(folder + "dihedral3_near.csv");
  NearCut cut;
  Sweep sweep{{frequency}, {}, false};
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const Direction direction{table.number(i, "theta_deg") * degree, table.number(i, "phi_deg") * degree};
    sweep.looks.push_back(near_look(direction, table.number(i, "range_m")));
    cut.reference.push_back({{{{table.complex(i, "vv"), 0.0}, {0.0, table.complex(i, "hh")}}}});
  }
  cut.computed = solve(Target(load_mesh(folder + "dihedral3.stl", 1.0).mesh), sweep, options).total;
  return cut;
}

// Where the level is within 20 dB of the largest.
double rms_db(const NearCut& cut, int channel) {
  const auto size = [&](std::size_t i) { return std::abs(cut.reference[i].at(channel, channel)); };
  double peak = 0.0;
  for (std::size_t i = 0; i < cut.reference.size(); ++i) peak = std::max(peak, size(i));
  std::vector<double> errors;
  for (std::size_t i = 0; i < cut.reference.size(); ++i)
    if (size(i) > 0.1 * peak)
      errors.push_back(dbsm(cut.computed[i].at(channel, channel)) - dbsm(cut.reference[i].at(channel, channel)));
  return rms(errors);
}

// A dihedral of 3 wavelengths from 2 and from 0.5 D^2/lambda, D = 5.2 wavelengths. The far field of the same solver is off by 0.3
// (V) and 0.5 dB (H) over the same looks, the full waves by some hundredths.
TEST(NearInteraction, DihedralIsThatOfFullWaves) {
  const NearCut with = near_cut(adaptive(true)), without = near_cut(adaptive(false));
  for (const int channel : {vv, hh}) {
    testing::measured(channel == vv ? "near dihedral, V, rms" : "near dihedral, H, rms", rms_db(with, channel), "dB");
    EXPECT_LT(rms_db(with, channel), 0.5);
    EXPECT_GT(rms_db(without, channel), 1.2);
  }
}

// How much S changes as antennas at different ranges change their places, over several looks; of its size, root mean square.
double lack_of_reciprocity(const Body& body, double unit, bool interaction) {
  double lacks = 0.0, sizes = 0.0;
  const auto total = [&](const Look& look) {
    return solve(body.target, {{frequency}, {look}, true}, adaptive(interaction)).total[0];
  };
  for (const auto& [phi, theta, other] : {std::array{65.0, 80.0, 35.0}, {30.0, 85.0, 55.0}, {50.0, 75.0, 40.0}}) {
    const Look look = near_look({90 * degree, phi * degree}, {theta * degree, other * degree}, 0.5 * unit, 0.8 * unit);
    const ScatteringMatrix there = total(look),
                           back = total({look.receive, look.transmit, look.receive_range, look.transmit_range});
    const ScatteringMatrix transposed{{{{back.vv(), back.hv()}, {back.vh(), back.hh()}}}};
    lacks += std::pow(frobenius_norm(there - transposed), 2);
    sizes += std::pow(frobenius_norm(there), 2);
  }
  return std::sqrt(lacks / sizes);
}

// Physical optics of several bounces is not reciprocal; waves between the faces make up for most of that, from afar and from
// near.
TEST(NearInteraction, MakesBistaticLooksReciprocal) {
  const Body body(shapes::dihedral(3 * lambda, 3 * lambda));
  const double far = lack_of_reciprocity(body, 1e6 * body.unit(), true), near = lack_of_reciprocity(body, body.unit(), true);
  testing::measured("exchange of antennas, dihedral, from afar", far, "");
  testing::measured("exchange of antennas, dihedral, at 0.5 and 0.8 D^2/lambda", near, "");
  EXPECT_LT(near, 1.5 * far);
  EXPECT_LT(near, 0.5 * lack_of_reciprocity(body, body.unit(), false));
}

void expect_each_frequency_of(const std::vector<double>& frequencies, double tolerance) {
  const Body all(shapes::dihedral(3 * lambda, 3 * lambda), frequencies);
  const Look look = near_look({80 * degree, 33 * degree}, all.unit());
  const InteractionResult band = all.near(look);
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    const Body one(shapes::dihedral(3 * lambda, 3 * lambda), {frequencies[f]});
    EXPECT_LT(difference(band.scattering[f], one.near(look).scattering[0]), tolerance);
  }
}

// Panel by panel a band is found at a few wavenumbers: a tenth of what the rules may leave.
TEST(NearInteraction, OfABandIsThatOfEachFrequency) { expect_each_frequency_of({9.8e9, 10e9, 10.1e9, 10.3e9}, 1e-4); }

// What reaches beyond the ends of edges does so by wavelengths of its own, whatever else is in the band.
TEST(NearInteraction, OfAWideBandIsThatOfEachFrequency) { expect_each_frequency_of({7.7e9, 12e9}, 1e-3); }

}  // namespace
}  // namespace raytube
