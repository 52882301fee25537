// Prolate spheroids, smooth and of uneven curvature, against exact amplitudes (tests/data/spheroids.py and, with an impedance,
// tests/data/impedance_spheroids.py).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

/// Half axes a (along z) and b, 5120 facets: a stretched icosphere, whose facets are smaller the sharper it bends.
Target spheroid(double a, double b) {
  const glm::dmat3 stretch(dvec3(b, 0, 0), dvec3(0, b, 0), dvec3(0, 0, a));
  return Target(build_mesh(shapes::transformed(shapes::icosphere(4), stretch), 1.0).mesh);
}

/// Amplitudes of one spheroid in steps of 5 degrees from the axis to broadside; VV, HH.
using Amplitudes = std::array<std::vector<Complex>, 2>;

Amplitudes tabled(const std::string& ratio, const std::string& ka) {
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/spheroids.csv");
  Amplitudes result;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.text(i, "ratio") != ratio || table.text(i, "ka") != ka) continue;
    result[0].push_back(table.complex(i, "vv"));
    result[1].push_back(table.complex(i, "hh"));
  }
  return result;
}

Amplitudes solved(double ratio, double ka, bool waves) {
  std::vector<Direction> looks;
  for (int i = 0; i < 19; ++i) looks.push_back({5 * i * degree, 0.0});
  const double a = ka / (2 * pi);
  SolveOptions options;
  options.surfaces.waves = waves;
  Amplitudes result;
  for (const ScatteringMatrix& s : solve(spheroid(a, a / ratio), monostatic(looks, speed_of_light), options).total) {
    result[0].push_back(s.vv());
    result[1].push_back(s.hh());
  }
  return result;
}

/// Over the looks whose reference is less than `range` dB below the highest.
double rms_db(const std::vector<Complex>& found, const std::vector<Complex>& expected, double range) {
  double peak = 0.0;
  for (const Complex s : expected) peak = std::max(peak, std::abs(s));
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (dbsm(expected[i]) > dbsm(peak) - range) errors.push_back(dbsm(found[i]) - dbsm(expected[i]));
  return rms(errors);
}

// Limits are what is measured and a quarter. What decides is how sharply the tips bend: k rho is ka / ratio^2, 2.5, 5 and 10,
// then 0.6, 1.25 and 2.5. Where it is above 4 or the looks see no tip it is a tenth of a decibel; what leaves the sharpest tips
// is not counted. The body of 4:1 and ka 10 is 0.8 wavelengths across: no waves run there (CurvedTarget::carries_waves), which
// made VV worse, 5.1 dB in place of 3.5, and HH better, 0.6 in place of 2.6.
TEST(Spheroids, AgainstExactAmplitudes) {
  struct Limit {
    const char *ratio, *ka;
    double vv, hh;  // rms over the looks within 20 dB of the peak [dB]
  };
  for (const Limit& limit : {Limit{"2", "10", 1.05, 0.95}, Limit{"2", "20", 0.2, 0.18}, Limit{"2", "40", 0.047, 0.047},
                             Limit{"4", "10", 4.4, 3.3}, Limit{"4", "20", 1.6, 1.15}, Limit{"4", "40", 0.11, 0.12}}) {
    const Amplitudes expected = tabled(limit.ratio, limit.ka);
    for (const bool waves : {false, true}) {
      const Amplitudes found = solved(std::stod(limit.ratio), std::stod(limit.ka), waves);
      for (int p = 0; p < 2; ++p) {
        const std::string name = fmt::format("spheroid {}:1, ka {}, {}, {} waves", limit.ratio, limit.ka, p == 0 ? "VV" : "HH",
                                             waves ? "with" : "without");
        measured((name + ", within 20 dB of the peak").c_str(), rms_db(found[p], expected[p], 20), "dB");
        measured((name + ", all looks").c_str(), rms_db(found[p], expected[p], 100), "dB");
        if (!waves) continue;
        EXPECT_LE(rms_db(found[p], expected[p], 20), p == 0 ? limit.vv : limit.hh) << name;
      }
    }
  }
}

/// A half-space so dense that its impedance over eta is the same at any angle.
Material dense(Complex impedance) {
  const Complex index = std::polar(200.0, -1.05);
  Material material;
  material.kind = MaterialKind::half_space;
  material.layers = {{Layer{{index / impedance, index * impedance}, 0.0}}};
  return material;
}

struct ImpedanceBody {
  std::string re_z, im_z, ratio, ka;
  double monostatic, bistatic;  // rms over both polarisations and all looks, of the largest amplitude

  Complex impedance() const { return {std::stod(re_z), std::stod(im_z)}; }
};

struct ImpedanceRows {
  std::vector<Look> looks;
  std::vector<std::array<Complex, 2>> expected;  // VV, HH but for their signs
};

ImpedanceRows rows_of(const ImpedanceBody& body, bool monostatic) {
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/impedance_spheroids.csv");
  ImpedanceRows rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.text(i, "re_z") != body.re_z || table.text(i, "im_z") != body.im_z || table.text(i, "ratio") != body.ratio ||
        table.text(i, "ka") != body.ka)
      continue;
    const double theta = table.number(i, "theta_deg"), receive = table.number(i, "rx_theta_deg");
    if ((theta == receive) != monostatic) continue;
    const Direction there = receive > 180.0 ? Direction{(360.0 - receive) * degree, pi} : Direction{receive * degree, 0.0};
    rows.looks.push_back({{theta * degree, 0.0}, there});
    rows.expected.push_back({table.complex(i, "vv"), table.complex(i, "hh")});
  }
  return rows;
}

double rms_of_magnitudes(const ImpedanceBody& body, bool monostatic, bool waves) {
  const ImpedanceRows rows = rows_of(body, monostatic);
  const double a = std::stod(body.ka) / (2 * pi);
  const LoadedMesh plain =
      build_mesh(shapes::transformed(shapes::icosphere(4), glm::dmat3(dvec3(a / std::stod(body.ratio), 0, 0),
                                                                      dvec3(0, a / std::stod(body.ratio), 0), dvec3(0, 0, a))),
                 1.0);
  TriangleMesh mesh = plain.mesh;
  for (Patch& patch : mesh.patches) patch.material = 0;
  SolveOptions options;
  options.surfaces.waves = waves;
  const std::vector<ScatteringMatrix> found =
      solve(Target(mesh), {{speed_of_light}, rows.looks, true, {}, {dense(body.impedance())}}, options).total;
  double squares = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int p = 0; p < 2; ++p) {
      squares += std::pow(std::abs(found[i].at(p, p)) - std::abs(rows.expected[i][p]), 2);
      peak = std::max(peak, std::abs(rows.expected[i][p]));
    }
  return std::sqrt(squares / (2.0 * static_cast<double>(found.size()))) / peak;
}

// Limits are what is measured and a quarter. Monostatic it is a half to a tenth of what physical optics leaves; in bistatic looks
// along bodies of 4:1 what leaves the tips is missing, as on conductors.
TEST(Spheroids, WithAnImpedanceAgainstExactAmplitudes) {
  for (const ImpedanceBody& body :
       {ImpedanceBody{"0.42", "-0.27", "2", "10", 0.0096, 0.041}, ImpedanceBody{"0.42", "-0.27", "2", "20", 0.0033, 0.022},
        ImpedanceBody{"0.42", "-0.27", "4", "20", 0.0059, 0.094}, ImpedanceBody{"0.42", "-0.27", "4", "40", 0.0023, 0.068},
        ImpedanceBody{"0.2", "0.3", "2", "10", 0.026, 0.094}, ImpedanceBody{"0.2", "0.3", "2", "20", 0.0088, 0.051},
        ImpedanceBody{"0.2", "0.3", "4", "20", 0.022, 0.088}, ImpedanceBody{"0.2", "0.3", "4", "40", 0.0071, 0.055}})
    for (const bool monostatic : {true, false}) {
      const std::string name = fmt::format("Z {} + {}j, {}:1, ka {}, {}", body.re_z, body.im_z, body.ratio, body.ka,
                                           monostatic ? "monostatic" : "bistatic");
      const double with = rms_of_magnitudes(body, monostatic, true);
      measured(name.c_str(), with, "of the peak");
      EXPECT_LE(with, monostatic ? body.monostatic : body.bistatic) << name;
      EXPECT_LE(with, monostatic ? 0.65 * rms_of_magnitudes(body, true, false) : 1.0) << name;
    }
}

}  // namespace
}  // namespace raytube
