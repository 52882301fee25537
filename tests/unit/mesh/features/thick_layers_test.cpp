// Which coats and sheets have no room on what is made of them.
#include <gmock/gmock.h>

#include "mesh/load.h"
#include "mesh/soundness/thick_layers.h"
#include "output/words/warnings.h"
#include "shapes.h"

namespace raytube {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double rounding = 1e-12;  // of coordinates of about 1 m

std::vector<Material> material(MaterialKind kind, double thickness) {
  return {{"rubber", kind, 0.0, {{{{}, 0.25 * thickness}, {{}, 0.75 * thickness}}}}};
}

// The first `facets` of them are of the material.
std::vector<ThickLayers> thick_on(PolygonSoup soup, std::size_t facets, const std::vector<Material>& materials) {
  soup.materials.assign(soup.polygons.size(), no_index);
  std::fill_n(soup.materials.begin(), facets, 0u);
  return find_thick_layers(build_mesh(soup, 1e-3, "test", materials).mesh, materials);
}

PolygonSoup turned_slab() {
  const double angle = 0.6;
  const glm::dmat3 turn({std::cos(angle), 0.0, -std::sin(angle)}, {0.0, 1.0, 0.0}, {std::sin(angle), 0.0, std::cos(angle)});
  return shapes::transformed(shapes::box({300.0, 200.0, 8.0}), turn, 1.0, dvec3(1000.0, 0.0, 0.0));
}

TEST(ThickLayers, ACoatOnBothSidesOfASlab) {
  const std::vector<ThickLayers> thick = thick_on(turned_slab(), 12, material(MaterialKind::coated, 5e-3));
  ASSERT_EQ(thick.size(), 1u);
  EXPECT_NEAR(thick[0].width, 8e-3, rounding);
  EXPECT_NEAR(thick[0].thickness, 5e-3, rounding);
  EXPECT_NEAR(glm::distance(thick[0].middle, dvec3(1.0, 0.0, 0.0)), 0.0, rounding);
  EXPECT_THAT(thick_on(turned_slab(), 12, material(MaterialKind::coated, 3.9e-3)), IsEmpty());
}

// A face of a slab has all of its thickness for itself, and so has a sheet.
TEST(ThickLayers, ACoatOnOneSide) {
  EXPECT_THAT(thick_on(turned_slab(), 2, material(MaterialKind::coated, 7.9e-3)), IsEmpty());
  EXPECT_EQ(thick_on(turned_slab(), 2, material(MaterialKind::coated, 8.1e-3)).size(), 1u);
  EXPECT_THAT(thick_on(turned_slab(), 12, material(MaterialKind::sheet, 7.9e-3)), IsEmpty());
  EXPECT_EQ(thick_on(turned_slab(), 12, material(MaterialKind::sheet, 8.1e-3)).size(), 1u);
}

// Open surfaces have no thickness of their own, but a width.
TEST(ThickLayers, APlateIsWiderThanItsSheet) {
  const PolygonSoup plate = shapes::plate(100.0);
  EXPECT_THAT(thick_on(plate, 2, material(MaterialKind::sheet, 30e-3)), IsEmpty());
  const std::vector<ThickLayers> thick = thick_on(plate, 2, material(MaterialKind::sheet, 150e-3));
  ASSERT_EQ(thick.size(), 1u);
  EXPECT_FALSE(thick[0].closed);
}

TEST(ThickLayers, HalfSpacesAreAsThickAsTheyAre) {
  EXPECT_THAT(thick_on(turned_slab(), 12, material(MaterialKind::half_space, 1.0)), IsEmpty());
  EXPECT_THAT(thick_on(turned_slab(), 12, {{"film", MaterialKind::thin_sheet, 0.0, {}, 100.0}}), IsEmpty());
}

TEST(ThickLayers, Words) {
  const std::vector<Material> rubber = material(MaterialKind::coated, 5e-3);
  EXPECT_THAT(
      thick_layer_warnings(thick_on(turned_slab(), 12, rubber), rubber, {1e-3, "mm"}),
      ElementsAre(HasSubstr("materials: the layers of \"rubber\" are 5 mm thick on both sides, but component 0 round (1000, "
                            "0, 0) mm is only 8 mm thick; check thickness_mm and target.unit")));
  const PolygonSoup two = shapes::joined(turned_slab(), shapes::box({3.0, 300.0, 200.0}));
  EXPECT_THAT(thick_layer_warnings(thick_on(two, 24, rubber), rubber, {1e-3, "mm"}),
              ElementsAre(HasSubstr("component 1 round (0, 0, 0) mm is only 3 mm thick (2 components are")));
}

}  // namespace
}  // namespace raytube
