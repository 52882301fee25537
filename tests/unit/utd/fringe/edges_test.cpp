// The edge pass as a whole: reference amplitudes, symmetry, and looks where one of its formulas is singular.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "strip_2d.h"
#include "unit/utd_scene.h"
#include "utd/fringe/edges.h"

namespace raytube {
namespace {

using test::frequency_1m;
using test::Scene;

constexpr std::array<double, 1> one_frequency{frequency_1m};

Look monostatic(double theta, double phi) { return {{theta, phi}, {theta, phi}}; }

EdgeLookResult first_order(const Scene& scene, const Tracer& tracer, const Look& look, std::span<const double> frequencies) {
  static const Outlines none;
  return fringe_scattering({scene.wedges, none, tracer}, look, {frequencies}, {1});
}

ScatteringMatrix scattering(const Scene& scene, const Tracer& tracer, const Look& look) {
  return first_order(scene, tracer, look, one_frequency).scattering[0];
}

double largest(const ScatteringMatrix& s) {
  return std::max({std::abs(s.vv()), std::abs(s.vh()), std::abs(s.hv()), std::abs(s.hh())});
}

double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) {
  return std::max({std::abs(a.vv() - b.vv()), std::abs(a.vh() - b.vh()), std::abs(a.hv() - b.hv()), std::abs(a.hh() - b.hh())});
}

/// Rows of numbers of a CSV file; lines that begin with '#' and the header are skipped.
std::vector<std::vector<double>> read_table(const std::string& name) {
  std::ifstream file(std::string(RAYTUBE_SOURCE_DIR) + "/tests/data/" + name);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || std::isalpha(line[0])) continue;
    std::istringstream fields(line);
    std::vector<double>& row = rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
  }
  return rows;
}

/// A single wedge of the table; its faces are so wide that the forward-grazing window vanishes.
Wedge table_wedge(const std::vector<double>& row) {
  const double a = row[0] * pi;
  const dvec3 x(row[1], row[2], row[3]), y(row[4], row[5], row[6]);
  const dvec3 other_x = std::cos(a) * x + std::sin(a) * y, other_y = std::sin(a) * x - std::cos(a) * y;
  return {{row[7], row[8], row[9]},
          {row[10], row[11], row[12]},
          row[0],
          {WedgeFace{0, x, y, 1e30}, WedgeFace{0, other_x, other_y, 1e30}}};
}

ScatteringMatrix table_amplitude(const std::vector<double>& row) {
  return {{{{{{row[17], row[18]}, {row[19], row[20]}}}, {{{row[21], row[22]}, {row[23], row[24]}}}}}};
}

TEST(Edges, AgreeWithAnIndependentImplementation) {
  Scene scene = test::plate(0.1, 0.1);  // patch 0, which the wedges name as their own: nothing is in the way
  const Tracer tracer(scene.mesh);
  const auto rows = read_table("edge_amplitudes.csv");
  ASSERT_EQ(rows.size(), 50u);
  for (const auto& row : rows) {
    const Look look{{row[13], row[14]}, {row[15], row[16]}};
    scene.wedges = {table_wedge(row)};
    const ScatteringMatrix reference = table_amplitude(row);
    // 1e-12 of the row's largest channel: rounding (1e-14) of phases of up to 1e2 rad.
    EXPECT_LE(difference(scattering(scene, tracer, look), reference), 1e-12 * largest(reference)) << "n = " << row[0];
  }
}

TEST(Edges, FrequenciesOfOnePassEqualSeparatePasses) {
  const Scene scene = test::plate(3, 3);
  const Tracer tracer(scene.mesh);
  const Look look{{1.4, 0.2}, {1.5, 0.2 + pi}};  // forward grazing, so that the window is at work too
  const std::array<double, 3> frequencies{0.7 * frequency_1m, frequency_1m, 1.6 * frequency_1m};
  const EdgeLookResult together = first_order(scene, tracer, look, frequencies);
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const EdgeLookResult alone = first_order(scene, tracer, look, std::span(&frequencies[i], 1));
    EXPECT_EQ(difference(together.scattering[i], alone.scattering[0]), 0.0);
    EXPECT_EQ(together.windowed[i], alone.windowed[0]);
  }
}

TEST(Edges, MonostaticPlateIsFiniteThroughEveryLook) {
  // All four edges of a plate of 3 wavelengths, from broadside through edge-on to the back. The largest value belongs to VV at
  // 8.5 degrees; 0.507 wavelengths is this theory's own figure, the tolerance its variation between half degrees.
  const Scene scene = test::plate(3, 3);
  const Tracer tracer(scene.mesh);
  double peak = 0.0;
  for (const double phi : {0.0, 1e-9, 1e-4, 0.3, pi / 4}) {
    for (int half_degree = 0; half_degree <= 360; ++half_degree) {
      const ScatteringMatrix s = scattering(scene, tracer, monostatic(half_degree * degree / 2, phi));
      ASSERT_TRUE(std::isfinite(largest(s))) << half_degree << ' ' << phi;
      peak = std::max(peak, largest(s));
    }
  }
  EXPECT_NEAR(peak, 0.507, 0.001);
}

TEST(Edges, MonostaticPlateEdgeOn) {
  // HH (soft at the near edge) is continuous through edge-on: 1e-3 is its change over 1e-5 rad. In VV the far edge, hard and
  // reached over the grazed plate, keeps a first-order value of 3/(2 pi) from either side that depends on the direction of
  // approach. Exactly edge-on it is defined as the mean of both sides of the plate, zero, which is also what a thin plate
  // returns.
  const Scene scene = test::plate(3, 3);
  const Tracer tracer(scene.mesh);
  for (const double phi : {0.0, 1e-9, 1e-4, 0.3, pi / 4}) {
    const ScatteringMatrix edge_on = scattering(scene, tracer, monostatic(pi / 2, phi));
    EXPECT_LE(std::abs(edge_on.vv()), 1e-12);
    for (const double step : {-1e-5, -1e-6, -1e-9, 1e-9, 1e-6, 1e-5}) {
      const ScatteringMatrix near = scattering(scene, tracer, monostatic(pi / 2 + step, phi));
      EXPECT_LE(std::abs(near.hh() - edge_on.hh()), 1e-3) << phi << ' ' << step;
      EXPECT_LE(largest(near), 3 / (2 * pi) + 1e-3) << phi << ' ' << step;
    }
  }
  EXPECT_NEAR(std::abs(scattering(scene, tracer, monostatic(pi / 2, 0)).hh()), 3 / (2 * pi), 1e-12);  // |G_s| = 1/2, both sides
}

TEST(Edges, MonostaticCubeFaceOn) {
  // Face-on, four faces are grazed. The polarisation soft to the grazed far edges is continuous (1e-3 over 1e-5 rad). The hard
  // one jumps by the far edges' share, the same to either side: c_n(pi) side / (2 pi) with c_n(pi) = cot(60 deg)/1.5 for n = 3/2.
  const Scene scene = test::cube(3);
  const Tracer tracer(scene.mesh);
  const double share = 3 / (2 * pi) / (1.5 * std::sqrt(3.0));
  const ScatteringMatrix face_on = scattering(scene, tracer, monostatic(pi / 2, 0));
  EXPECT_NEAR(std::abs(face_on.vv() - face_on.hh()), 0.0, 1e-12);
  for (const double step : {-1e-5, -1e-6, 1e-6, 1e-5}) {
    const ScatteringMatrix turned = scattering(scene, tracer, monostatic(pi / 2, step));
    const ScatteringMatrix tilted = scattering(scene, tracer, monostatic(pi / 2 + step, 0));
    EXPECT_LE(std::abs(turned.vv() - face_on.vv()), 1e-3) << step;
    EXPECT_LE(std::abs(tilted.hh() - face_on.hh()), 1e-3) << step;
    EXPECT_NEAR(std::abs(turned.hh() - face_on.hh()), share, 1e-3) << step;
    EXPECT_NEAR(std::abs(tilted.vv() - face_on.vv()), share, 1e-3) << step;
  }
}

TEST(Edges, ForwardGrazingStaysBounded) {
  // Without the window the plate's fringe amplitude grows as 1/elevation: 2.3, 5, 13, 27, 273 wavelengths at 10, 5, 2, 1, 0.1
  // degrees. With it the pole is at most 1/delta = 6 at a width of 3 wavelengths, and the amplitude stays below 4.
  const Scene scene = test::plate(3, 3);
  const Tracer tracer(scene.mesh);
  for (const double elevation : {10.0, 5.0, 2.0, 1.0, 0.1, 0.01, 1e-6}) {
    const Look look{{pi / 2 - elevation * degree, 0}, {pi / 2 - elevation * degree, pi}};
    const EdgeLookResult result = first_order(scene, tracer, look, one_frequency);
    EXPECT_LE(largest(result.scattering[0]), 4.0) << elevation;
    EXPECT_TRUE(result.windowed[0]);
  }
}

TEST(Edges, WindowNeverTouchesMonostaticLooks) {
  const Scene scene = test::cube(3);
  const Tracer tracer(scene.mesh);
  for (double theta = 0.05; theta < pi; theta += 0.1)
    for (double phi = 0.0; phi < pi; phi += 0.1)
      EXPECT_FALSE(first_order(scene, tracer, monostatic(theta, phi), one_frequency).windowed[0]);
}

TEST(Edges, ConcaveAndTurnedAwayWedgesAddNothing) {
  Scene scene = test::cube(1);
  const Tracer tracer(scene.mesh);
  const auto lit = [&](const Look& look) { return first_order(scene, tracer, look, one_frequency).wedges_lit; };
  EXPECT_EQ(lit(monostatic(0.9, 0.7)), 9u);      // three faces lit: all but the three edges of the far corner
  EXPECT_EQ(lit(monostatic(pi / 2, 0.7)), 11u);  // top and bottom grazed: only the far upright edge is hidden
  for (Wedge& wedge : scene.wedges) wedge.n = 0.5;
  EXPECT_EQ(lit(monostatic(0.9, 0.7)), 0u);
}

TEST(Edges, StripHasTheFirstOrderAmplitudeOfItsTwoEdges) {
  // A strip of 5 wavelengths across x, of unit length along z and cut there without edges, so that S is S per unit length, j P /
  // pi.
  const double width = 5.0;
  Scene strip;
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  test::add_panel(strip.mesh, dvec3(0.0), x * (width / 2), z / 2.0);
  for (const double side : {1.0, -1.0})
    strip.wedges.push_back(
        test::half_plane(x * (side * width / 2) - z / 2.0, x * (side * width / 2) + z / 2.0, -side * x, y, width, 0));
  const Tracer tracer(strip.mesh);
  for (double elevation = degree; elevation < pi / 2; elevation += degree)
    for (const bool hard : {false, true}) {
      const auto amplitude = [&](int order) { return testing::strip_amplitude(width, elevation, elevation, order, hard); };
      const Complex fringe = amplitude(testing::untruncated_strips) - amplitude(testing::physical_optics);
      const Complex found = scattering(strip, tracer, monostatic(pi / 2, elevation)).at(hard, hard);
      EXPECT_LE(std::abs(found - Complex(0, (hard ? -1 : 1) / pi) * fringe), 1e-12)
          << elevation / degree;  // the same sum, some 1e3 roundings
    }
}

}  // namespace
}  // namespace raytube
