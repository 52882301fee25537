// Line-of-sight transmission: what a body behind sheets scatters, in any direction, is what it scatters without them times the
// transmission along both lines of sight.
#include <gtest/gtest.h>

#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

const Material laminate = layered(MaterialKind::sheet, {{{{4.0, -0.1}}, 3e-3}});

void add(PolygonSoup& soup, const PolygonSoup& other, std::uint32_t material, const dvec3& moved) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (const dvec3& p : other.points) soup.points.push_back(p + moved);
  for (std::vector<std::uint32_t> polygon : other.polygons) {
    for (std::uint32_t& corner : polygon) corner += first;
    soup.polygons.push_back(polygon);
    soup.materials.push_back(material);
  }
}

// A rectangle in a plane of constant z.
PolygonSoup rectangle(const dvec2& low, const dvec2& high, double z) {
  return {{{low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

// What a body adds to the sheets around it.
ScatteringMatrix behind(const PolygonSoup& body, const PolygonSoup& sheets, const Direction& from, const Direction& to,
                        const TubeOptions& tubes = {}) {
  PolygonSoup both = sheets;
  both.materials.assign(sheets.polygons.size(), 0);
  const Scene alone{both, {laminate}, tubes};
  add(both, body, no_index, dvec3(0.0));
  return Scene{both, {laminate}, tubes}.seen(from, to) - alone.seen(from, to);
}

// In planes through z, of sheets across z: V is TM and H is TE.
ScatteringMatrix through(ScatteringMatrix s, double from, double to, int sheets = 1) {
  const SurfaceResponse in = response(laminate, 0, k, std::abs(std::cos(from * degree)), false),
                        out = response(laminate, 0, k, std::abs(std::cos(to * degree)), false);
  for (int i = 0; i < sheets; ++i)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        s.at(p, q) *= (p == 0 ? out.transmitted.tm : out.transmitted.te) * (q == 0 ? in.transmitted.tm : in.transmitted.te);
  return s;
}

// Off its specular direction. Tubes end at the plate, so that nothing goes to and fro. Rounding of k r = 4000.
TEST(LineOfSight, APlateFarBehindASheetIsReceivedThroughItInItsSideLobes) {
  const PolygonSoup plate = shapes::plate(10.0 * lambda);
  const PolygonSoup near = rectangle(dvec2(-50.0 * lambda), dvec2(50.0 * lambda), 66.0 * lambda);
  PolygonSoup two = near;
  add(two, near, 0, dvec3(0.0, 0.0, 5.0 * lambda));
  for (const double theta : {6.0, 9.3, 20.0}) {
    const Direction look = deg(theta, 20.0);
    const ScatteringMatrix bare = Scene{plate, {}}.seen(look, look);
    for (int sheets = 1; sheets <= 2; ++sheets) {
      TubeOptions tubes;
      tubes.max_bounces = sheets + 1;
      EXPECT_LT(difference(behind(plate, sheets == 1 ? near : two, look, look, tubes), through(bare, theta, theta, sheets)), 1e-9)
          << theta;
    }
  }
}

// Cells at 10 a wavelength end in stairs along the plate: 0.3 of a wavelength's square in 100, of that the share in its lobe.
TEST(LineOfSight, UniformTubesAgree) {
  const PolygonSoup plate = shapes::plate(10.0 * lambda),
                    sheet = rectangle(dvec2(-50.0 * lambda), dvec2(50.0 * lambda), 66.0 * lambda);
  const Direction look = deg(8.0, 0.0);  // close to the top of the second side lobe
  TubeOptions tubes;
  tubes.mode = TubeMode::uniform;
  const ScatteringMatrix expected = through(Scene{plate, {}}.seen(look, look), 8.0, 8.0);
  EXPECT_LT(difference(behind(plate, sheet, look, look, tubes), expected), 0.03);
}

// Half of the plate stands behind the sheet, for both antennas: its edge lies above the middle of the plate along both lines.
TEST(LineOfSight, TheEdgeOfASheetDividesWhatIsReceivedThroughIt) {
  const double h = 5.0 * lambda, height = 40.0 * lambda, theta = 24.0, middle = height * std::tan(theta * degree);
  const PolygonSoup sheet = rectangle({middle, -30.0 * lambda}, {middle + 60.0 * lambda, 30.0 * lambda}, height);
  const Direction look = deg(theta, 0.0);
  const PolygonSoup covered = rectangle({0.0, -h}, {h, h}, 0.0), open = rectangle({-h, -h}, {0.0, h}, 0.0);
  const ScatteringMatrix expected = through(Scene{covered, {}}.seen(look, look), theta, theta) + Scene{open, {}}.seen(look, look);
  EXPECT_LT(difference(behind(shapes::plate(2.0 * h), sheet, look, look), expected), 1e-9);
}

// Only the receiver has the sheet before it, in the mirror direction of the plate, where none of the shadow's lobe arrives; and
// the other way round only the transmitter.
TEST(LineOfSight, ASheetBeforeOneOfTheAntennasCountsOnce) {
  const PolygonSoup plate = shapes::plate(10.0 * lambda),
                    sheet = rectangle({10.0 * lambda, -40.0 * lambda}, {90.0 * lambda, 40.0 * lambda}, 40.0 * lambda);
  const Direction open = deg(45.0, 180.0), covered = deg(45.0, 0.0);
  ScatteringMatrix out = Scene{plate, {}}.seen(open, covered), in = out;
  const SurfaceResponse at = response(laminate, 0, k, std::cos(45.0 * degree), false);
  for (int q = 0; q < 2; ++q) {
    out.at(0, q) *= at.transmitted.tm, out.at(1, q) *= at.transmitted.te;
    in.at(q, 0) *= at.transmitted.tm, in.at(q, 1) *= at.transmitted.te;
  }
  // The sheet reflects some of the wave into its own lobes, on to the plate and back: none of it has this direction, but its side
  // lobes of 1e-3 have.
  EXPECT_LT(difference(behind(plate, sheet, open, covered), out), 1e-9);
  EXPECT_LT(difference(behind(plate, sheet, covered, open), in), 1e-9);
}

// Behind both the sheet and the plate nothing is left of the incident wave: (T - 1) - T = -1.
TEST(LineOfSight, TheShadowBehindASheetIsWhole) {
  const PolygonSoup plate = shapes::plate(10.0 * lambda);
  PolygonSoup both = rectangle(dvec2(-5.0 * lambda), dvec2(5.0 * lambda), 6.0 * lambda);
  both.materials.assign(2, 0);
  add(both, plate, no_index, dvec3(0.0));
  const ScatteringMatrix shadow = Scene{plate, {}}.seen(deg(0.0, 0.0), deg(180.0, 0.0));
  EXPECT_LT(difference(Scene{both, {laminate}}.seen(deg(0.0, 0.0), deg(180.0, 0.0)), shadow), 1e-9);
}

// The receiver in the plane of the plate: what it receives does not jump there.
TEST(LineOfSight, EdgeOnIsTheLimitOfAlmostEdgeOn) {
  const PolygonSoup plate = shapes::plate(10.0 * lambda);
  PolygonSoup sheet{{{40.0 * lambda, -60.0 * lambda, -30.0 * lambda},
                     {40.0 * lambda, 60.0 * lambda, -30.0 * lambda},
                     {40.0 * lambda, 60.0 * lambda, 30.0 * lambda},
                     {40.0 * lambda, -60.0 * lambda, 30.0 * lambda}},
                    {{0, 1, 2}, {0, 2, 3}}};
  const Direction from = deg(30.0, 160.0);
  const ScatteringMatrix in_plane = behind(plate, sheet, from, deg(90.0, 10.0));
  // 1e-4 degrees turn phases across the plate by 1e-4.
  EXPECT_LT(difference(behind(plate, sheet, from, deg(90.0 - 1e-4, 10.0)), in_plane), 1e-3);
  EXPECT_GT(difference(Scene{plate, {}}.seen(from, deg(90.0, 10.0)), in_plane), 0.05);
}

}  // namespace
}  // namespace raytube
