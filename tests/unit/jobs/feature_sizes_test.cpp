// Sizes of what a target is made of, and which of them are told.
#include "mesh/features/feature_sizes.h"

#include <gmock/gmock.h>

#include "jobs/warnings/warnings.h"
#include "mesh/load.h"
#include "output/words/warnings.h"
#include "scene/sampling.h"
#include "shapes.h"

namespace raytube {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FeatureSizes sizes_of(const PolygonSoup& soup) { return feature_sizes(build_mesh(soup, 1.0, "test").mesh, 15.0 * degree); }

// A triangle's own curvature is that of the body within some per cent of regular tessellations.
TEST(FeatureSizes, RadiiOfCurvature) {
  const FeatureSizes ball = sizes_of(shapes::icosphere(4, 0.3)), pipe = sizes_of(shapes::cylinder(0.3, 2.0, 72));
  double area = 0.0;
  for (const SizedArea& radius : ball.radii) {
    EXPECT_NEAR(radius.size, 0.3, 0.2 * 0.3);  // icospheres are not regular about their twelve first corners
    area += radius.area;
  }
  EXPECT_NEAR(area, ball.area, 1e-12);
  double bent = 0.0;
  for (const SizedArea& radius : pipe.radii)
    if (radius.size < 1.0) {
      EXPECT_NEAR(radius.size, 0.3, 0.01 * 0.3);
      bent += radius.area;
    }
  EXPECT_NEAR(bent, 2.0 * pi * 0.3 * 2.0, 0.01 * bent);  // the wall, whose facets are a little smaller; the ends are flat
}

TEST(FeatureSizes, FacesEndAtEdges) {
  const FeatureSizes cube = sizes_of(shapes::cube(2.0)), pipe = sizes_of(shapes::cylinder(0.3, 2.0, 72));
  EXPECT_EQ(cube.components.size(), 1u);
  ASSERT_EQ(cube.faces.size(), 6u);
  for (const SizedArea& face : cube.faces) {
    EXPECT_NEAR(face.size, 2.0 * std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(face.area, 4.0, 1e-12);
  }
  EXPECT_EQ(pipe.faces.size(), 3u);
  EXPECT_EQ(sizes_of(shapes::joined(shapes::cube(1.0), shapes::transformed(shapes::cube(0.1), glm::dmat3(1.0), 1.0, {9, 0, 0})))
                .components.size(),
            2u);
}

Validity validity(const PolygonSoup& soup, double frequency) {
  const Target target(build_mesh(soup, 1.0, "test").mesh);
  const std::vector<dvec3> outermost = outermost_points(target.mesh.vertices);
  return validity_of(target, {{2.0 * frequency, frequency}, {}}, outermost);
}

std::vector<std::string> warnings(const PolygonSoup& soup, double frequency) {
  return validity_warnings(validity(soup, frequency));
}

TEST(ValidityWarnings, TargetsUnderThreeWavelengths) {
  const double three = 3.0 * speed_of_light / std::sqrt(3.0);  // the diagonal of a cube of 1 m is three wavelengths
  EXPECT_TRUE(too_small(validity(shapes::cube(1.0), three * 0.999)));
  EXPECT_FALSE(too_small(validity(shapes::cube(1.0), three * 1.001)));
  EXPECT_THAT(warnings(shapes::cube(1.0), three * 1.001), IsEmpty());
  EXPECT_THAT(
      warnings(shapes::cube(1.0), three / 3.0),
      ElementsAre("validity: the target's largest extent, 1732 mm, is 1 wavelengths at 0.1731 GHz, and the methods require 3; "
                  "below 0.5193 GHz treat results as approximate, or use a full-wave program"));
}

TEST(ValidityWarnings, AnImplausibleSizeNamesTheUnit) {
  const double one = speed_of_light / std::sqrt(3.0);  // the diagonal of a cube of 1 m is one wavelength
  EXPECT_THAT(warnings(shapes::cube(1.0), one * 0.499), ElementsAre(HasSubstr("target.unit")));
  EXPECT_THAT(warnings(shapes::cube(1.0), one * 0.501), ElementsAre(::testing::Not(HasSubstr("target.unit"))));
  EXPECT_THAT(warnings(shapes::cube(1.0), one * 4999.0), IsEmpty());
  EXPECT_THAT(warnings(shapes::cube(1.0), one * 5001.0), ElementsAre(HasSubstr("target.unit")));
}

// Of two cubes the small one's surface is a share of 1 / (1 + 100) of the whole with sides of 1 to 10, 1 / (1 + 98) with 9.9.
TEST(ValidityWarnings, SeparatePartsThatMatter) {
  const auto two = [](double side) {
    return shapes::joined(shapes::cube(1.0), shapes::transformed(shapes::cube(side), glm::dmat3(1.0), 1.0, {9.0, 0.0, 0.0}));
  };
  const double frequency = speed_of_light / 0.3;  // the small cube's diagonal of 0.17 m is under a wavelength, its faces too
  EXPECT_THAT(warnings(two(0.0990), frequency), IsEmpty());
  EXPECT_THAT(
      warnings(two(0.1010), frequency),
      ElementsAre(AllOf(HasSubstr("1 separate parts, 1 % of the surface, are smaller than a wavelength at 0.9993 GHz (300 mm)"),
                        HasSubstr("raise the frequency")),
                  HasSubstr("6 faces between edges, 1 % of the surface")));
  EXPECT_THAT(warnings(two(0.1010), speed_of_light / 0.1), IsEmpty());
}

TEST(ValidityWarnings, RadiiUnderAWavelength) {
  const PolygonSoup pipe = shapes::cylinder(0.3, 2.0, 72);
  EXPECT_THAT(warnings(pipe, speed_of_light / 0.29), IsEmpty());
  EXPECT_THAT(warnings(pipe, speed_of_light / 0.31),
              ElementsAre(AllOf(HasSubstr("87 % of the surface is bent to radii smaller than a "
                                          "wavelength at 0.9671 GHz (310 mm)"),
                                HasSubstr("waves around such bends"))));
}

// 16 facets about a pipe are seen as 16 faces with edges between them.
TEST(ValidityWarnings, FacetsTakenForFaces) {
  EXPECT_THAT(warnings(shapes::cylinder(2.0, 0.5, 16), speed_of_light / 0.95),
              ::testing::Contains(AllOf(HasSubstr("16 faces between edges"), HasSubstr("edges.min_wedge_deg"))));
}

TEST(SamplingWarnings, SayStepLimitAndRemedy) {
  EXPECT_THAT(
      sampling_warnings({{RowCoordinates::phi, 5.0, 0.02199}, {RowCoordinates::frequency, 0.05, 0.0347}}),
      ElementsAre(
          "sampling: steps of 5 deg in phi are too wide for this target's lobes, which require 0.021 deg or less; take finer "
          "steps, or read each row by itself (rcs.png shows points, not lines)",
          "sampling: steps of 0.05 GHz in frequency are too wide for a range profile: it repeats after 3 m, and the target is "
          "4.32 m "
          "deep; take steps of 0.034 GHz or less, or read each row by itself (rcs.png shows points, not lines)"));
}

}  // namespace
}  // namespace raytube
