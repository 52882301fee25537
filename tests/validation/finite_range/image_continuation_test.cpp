// Edge currents that run on as images over a right-angled corner, against image theory.
#include <gtest/gtest.h>

#include "dihedral_2d.h"
#include "run.h"
#include "shapes.h"
#include "utd/multiple/multiple_diffraction.h"

namespace raytube {
namespace {

using namespace raytube::testing;

/// The first frequency is compared; the second one, six times as high, makes the points along the edges dense enough to be
/// exact.
constexpr double frequencies[] = {speed_of_light, 6 * speed_of_light};

/// A face in z = 0, and walls that meet it at right angles over both its sides.
class CornerScene {
 public:
  CornerScene(PolygonSoup soup, bool quadrant)
      : quadrant_(quadrant), loaded_(build_mesh(std::move(soup), 1.0)), target_(loaded_.mesh) {}

  /// Strips of the free edges of the face where x, and with `quadrant` y, are positive.
  ScatteringMatrix strips(const LookVectors& look, int order, bool continue_by_images) const {
    ScatteringMatrix result = strips_at(frequencies, look, order, continue_by_images)[0];
    return result *= std::polar(1.0, 2 * pi * glm::dot(look.scattered - look.incident, loaded_.mesh.center));
  }

  /// Those strips at several frequencies; phase reference: centre of the mesh.
  std::vector<ScatteringMatrix> strips_at(std::span<const double> at, const LookVectors& look, int order,
                                          bool continue_by_images = true) const {
    const dvec3& center = loaded_.mesh.center;
    MultipleDiffraction diffraction(target_.wedges, target_.outlines, nullptr, look, at, order, continue_by_images);
    for (std::uint32_t i = 0; i < target_.wedges.size(); ++i) {
      const Wedge& wedge = target_.wedges[i];
      const dvec3 start = wedge.start + center, end = wedge.end + center;
      if (wedge.n != 2.0 || std::abs(start.z) + std::abs(end.z) > rounding) continue;
      LitInterval lit{0.0, 1.0};
      keep_positive(start.x, end.x, lit);
      if (quadrant_) keep_positive(start.y, end.y, lit);
      if (lit.begin < lit.end) diffraction.add(i, incidence_on(wedge, look.incident), std::span(&lit, 1));
    }
    StripSums sums = diffraction.take();
    for (std::size_t i = 0; i < at.size(); ++i) sums.first[i] += sums.higher[i];
    return sums.first;
  }

 private:
  static constexpr double rounding = 1e-9;

  static void keep_positive(double start, double end, LitInterval& lit) {
    if (std::max(start, end) < rounding) lit.end = 0.0;
    if (start < -rounding && end > rounding) lit.begin = std::max(lit.begin, start / (start - end));
    if (end < -rounding && start > rounding) lit.end = std::min(lit.end, start / (start - end));
  }

  bool quadrant_;
  LoadedMesh loaded_;
  Target target_;
};

LookVectors turned(LookVectors look, const dvec3& mirror) {
  look.scattered *= mirror;
  for (dvec3& receive : look.receive) receive *= mirror;
  return look;
}

const Look looks[] = {{{0.9, 0.4}, {1.3, 2.1}}, {{0.7, -0.6}, {0.7, -0.6}}, {{1.2, 2.4}, {2.0, -1.0}}, {{2.1, 0.9}, {0.5, 3.0}}};

/// Largest difference between two scenes in the sum over the mirrors of S(s) with a receiver mirrored like s, each mirror with
/// the sign -1; and the largest sum.
std::pair<double, double> compare(const CornerScene& corner, const CornerScene& plate, std::span<const dvec3> mirrors,
                                  bool continue_by_images = true) {
  double worst = 0.0, size = 0.0;
  for (const Look& look : looks)
    for (const int order : {1, 2, 3}) {
      ScatteringMatrix wall, image;
      for (const dvec3& mirror : mirrors) {
        const LookVectors there = turned(look_vectors(look), mirror);
        const double sign = mirror.x * mirror.y;
        wall += corner.strips(there, order, continue_by_images) *= sign;
        image += plate.strips(there, order, continue_by_images) *= sign;
      }
      worst = std::max(worst, largest_amplitude(wall - image));
      size = std::max(size, largest_amplitude(image));
    }
  return {worst, size};
}

/// A trapezoid at a wall: its strips meet the corner in all directions. Without the wall, the face and its image.
PolygonSoup trapezoid(bool wall) {
  PolygonSoup soup{{{0, -1.5, 0}, {2.5, -1.1, 0}, {2.5, 1.2, 0}, {0, 1.2, 0}}, {{0, 1, 2, 3}}};
  if (wall) {
    soup.points.insert(soup.points.end(), {{0, -1.5, 2}, {0, 1.2, 2}, {0, -1.5, -2}, {0, 1.2, -2}});
    soup.polygons.insert(soup.polygons.end(), {{0, 3, 5, 4}, {0, 6, 7, 3}});
  } else {
    soup.points.insert(soup.points.end(), {{-2.5, -1.1, 0}, {-2.5, 1.2, 0}});
    soup.polygons.push_back({0, 3, 5, 4});
  }
  return soup;
}

/// A rectangle in the corner of two walls, and the plate that it is a quarter of.
PolygonSoup quarter(bool walls) {
  if (!walls) return {{{-2.5, -1.3, 0}, {2.5, -1.3, 0}, {2.5, 1.3, 0}, {-2.5, 1.3, 0}}, {{0, 1, 2, 3}}};
  return {{{0, 0, 0},
           {2.5, 0, 0},
           {2.5, 1.3, 0},
           {0, 1.3, 0},
           {0, 0, 2},
           {2.5, 0, 2},
           {0, 1.3, 2},
           {0, 0, -2},
           {2.5, 0, -2},
           {0, 1.3, -2}},
          {{0, 1, 2, 3}, {0, 3, 6, 4}, {0, 7, 9, 3}, {0, 4, 5, 1}, {0, 1, 8, 7}}};
}

// F of the face with its walls, P of the face with its images, of which the edges in front of the walls are lit. There both have
// the same current J, apart from what walls mirror; J' = -R J, R the mirror: F(s) - R F(Rs) = P(s) - R P(Rs).
TEST(ImageContinuation, StripsOfAFaceAtAWallAreThoseOfTheFaceAndItsImage) {
  const CornerScene corner(trapezoid(true), false), plate(trapezoid(false), false);
  const dvec3 mirrors[] = {{1, 1, 1}, {-1, 1, 1}};
  const auto [worst, size] = compare(corner, plate, mirrors);
  measured("strips at a wall against strips of the image, largest difference", worst / size, "");
  EXPECT_LE(worst, 1e-6 * size);  // of the rules along the edges: the wall cuts other panels
  EXPECT_GE(compare(corner, plate, mirrors, false).first, 0.05 * size);
}

TEST(ImageContinuation, StripsInTheCornerOfTwoWallsAreThoseOfTheFaceAndItsImages) {
  const CornerScene corner(quarter(true), true), plate(quarter(false), true);
  const dvec3 mirrors[] = {{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {-1, -1, 1}};
  const auto [worst, size] = compare(corner, plate, mirrors);
  measured("strips between two walls against strips of the images, largest difference", worst / size, "");
  EXPECT_LE(worst, 1e-6 * size);
  EXPECT_GE(compare(corner, plate, mirrors, false).first, 0.05 * size);
}

TEST(ImageContinuation, OfADihedralIsThatInTwoDimensions) {
  // Strips of the outer edge of the plate at y = 0, across the inner edge; S = j P L / pi of a height L (soft), -j P L / pi
  // (hard).
  constexpr double w = 3.0, height = 2.0;
  const LoadedMesh loaded = build_mesh(shapes::dihedral(w, height), 1.0);
  const Target target(loaded.mesh);
  const auto outer = std::ranges::find_if(
      target.wedges, [&](const Wedge& wedge) { return std::min(wedge.start.x, wedge.end.x) + loaded.mesh.center.x > w - 1e-9; });
  ASSERT_NE(outer, target.wedges.end());
  constexpr LitInterval all{0.0, 1.0};
  for (const double from : {20.0, 50.0, 300.0})
    for (const double to : {20.0, 61.0, 130.0, 200.0, 333.0}) {
      const LookVectors look = look_vectors({{pi / 2, from * degree}, {pi / 2, to * degree}});
      MultipleDiffraction diffraction(target.wedges, target.outlines, nullptr, look, frequencies, 1, true);
      diffraction.add(static_cast<std::uint32_t>(outer - target.wedges.begin()), incidence_on(*outer, look.incident),
                      std::span(&all, 1));
      const StripSums sums = diffraction.take();
      const Complex per_height = std::polar(pi / height, 2 * pi * glm::dot(look.scattered - look.incident, loaded.mesh.center));
      const ScatteringMatrix found = sums.first[0] + sums.higher[0];
      for (const bool hard : {false, true}) {
        const Dihedral2d flat(pi / 2, w, hard);
        const Complex p = flat.fringe(flat.edge_lights(from * degree, 0)[0], to * degree, FringeEnd::mirrored);
        const Complex s = (hard ? found.hh() : found.vv()) * per_height;
        EXPECT_LE(std::abs(s - Complex(0.0, hard ? -1.0 : 1.0) * p), 1e-12)
            << from << ' ' << to << ' ' << hard;  // the same kernels
      }
    }
}

TEST(ImageContinuation, OtherAnglesThanTheRightOneDoNotMirror) {
  PolygonSoup soup = trapezoid(true);
  for (std::size_t i = 4; i < soup.points.size(); ++i) soup.points[i].x = 0.2 * soup.points[i].z;
  const CornerScene leaning(soup, false);
  const LookVectors look = look_vectors(looks[0]);
  const ScatteringMatrix asked = leaning.strips_at(frequencies, look, 2, true)[0];
  EXPECT_GT(largest_amplitude(asked), 0.01);
  EXPECT_EQ(largest_amplitude(asked - leaning.strips_at(frequencies, look, 2, false)[0]), 0.0);
}

TEST(ImageContinuation, ManyFrequenciesAreThoseOfEachAlone) {
  // Of many, a few are computed and the others interpolated; both share the points of the highest one. The limit is a hundredth
  // of what math/path_bins promises of amplitudes that add up to some wavelengths.
  const CornerScene corner(quarter(true), true);
  const LookVectors look = look_vectors(looks[0]);
  std::vector<double> many;
  for (int i = 0; i <= 100; ++i) many.push_back(speed_of_light * (1 + 0.001 * i));
  const std::vector<ScatteringMatrix> together = corner.strips_at(many, look, 3);
  double worst = 0.0;
  for (int i = 0; i <= 100; i += 7) {
    const double few[] = {many[i], many.back()};
    worst = std::max(worst, largest_amplitude(together[i] - corner.strips_at(few, look, 3)[0]));
  }
  measured("mirrored strips, many frequencies against each alone", worst, "wavelengths");
  EXPECT_LE(worst, 1e-8);
}

}  // namespace
}  // namespace raytube
