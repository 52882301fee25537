// An image of a look as files.
#include <gmock/gmock.h>

#include "output/tables/image_csv.h"
#include "output/vtk/image_vtu.h"
#include "run.h"
#include "scratch.h"
#include "vtk_file.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

ScatteringMatrix matrix(double size) {
  return {{{{Complex(size, 0.5 * size), Complex(0.0)}, {Complex(0.0), Complex(-size, 0.0)}}}};
}

LookImage image_of(std::uint32_t columns, std::uint32_t rows) {
  LookImage image{0, 1e9, {{1, 0, 0}, {0, 1, 0}, {-1.0, 2.0}, {0.1, 0.2}, columns, rows}, {}, {}, {}};
  image.cells.assign(image.lattice.cells(), matrix(1.0));
  return image;
}

const Sweep sweep{{1e9}, {{{0.0, 0.0}, {0.0, 0.0}}}, false};

TEST(ImageCsv, RowsGoUpAndColumnsToTheRight) {
  const Scratch scratch;
  LookImage image = image_of(3, 2);
  image.cells[image.lattice.index({2, 1})] = matrix(4.0);
  write_image_csv(scratch / "image.csv", sweep, image);
  const Table table((scratch / "image.csv").string());
  ASSERT_EQ(table.rows(), 6u);
  EXPECT_EQ(table.number(5, "row"), 1.0);
  EXPECT_EQ(table.number(5, "col"), 2.0);
  EXPECT_NEAR(table.number(5, "u_m"), -0.75, 1e-15);
  EXPECT_NEAR(table.number(5, "v_m"), 2.3, 1e-15);
  EXPECT_EQ(table.complex(5, "vv"), Complex(4.0, 2.0));
  EXPECT_NEAR(table.number(5, "sigma_hh_dbsm"), dbsm(4.0), 0.005);  // two decimals
  EXPECT_EQ(table.text(5, "sigma_vh_dbsm"), "-inf");
  EXPECT_NEAR(table.number(5, "phase_hh_rad"), pi, 5e-5);  // four decimals
  EXPECT_THAT(text_of(scratch / "image.csv"), HasSubstr("# 3 columns of 0.1 m along u = (1, 0, 0), 2 rows of 0.2 m"));
}

// A report lays the image over its target without perspective: where the middle is seen it fits.
TEST(ImageCsv, PerspectivesSayWhereTheyAreToScale) {
  const Scratch scratch;
  LookImage image = image_of(3, 2);
  image.lattice.curvature = 1.0 / 3.0, image.lattice.middle_of_target = {0.25, -0.5, 1.0};
  write_image_csv(scratch / "image.csv", sweep, image);
  EXPECT_THAT(text_of(scratch / "image.csv"), HasSubstr("(0.25, -0.5, 1)"));
  EXPECT_EQ(image.lattice.project({0.0, 0.0, 0.0}), dvec2(0.0));
  const dvec2 middle = image.lattice.project(image.lattice.middle_of_target);  // the origin is 1 m farther than it: 3 m are seen as 4
  EXPECT_NEAR(middle.x, 0.25 * 3.0 / 4.0, 1e-15);
  EXPECT_NEAR(image.lattice.shift_of_perspective().x, 0.25 / 4.0, 1e-15);
}

TEST(ImageVtu, HoldsTrianglesThenEdges) {
  const Scratch scratch;
  LookImage image = image_of(1, 1);
  image.triangles = {matrix(1.0), {}};
  image.edges = {{{0, 0, 0}, {0.5, 0, 0}, matrix(2.0)}};
  const std::vector<dvec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.25}};
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  write_image_vtu(scratch / "image.vtu", corners, triangles, image);
  const std::string text = text_of(scratch / "image.vtu");
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=\"6\" NumberOfCells=\"3\""));
  EXPECT_EQ(vtk_numbers(text, "points").size(), 18u);
  EXPECT_EQ(vtk_numbers(text, "connectivity"), (std::vector<double>{0, 1, 2, 0, 2, 3, 4, 5}));
  EXPECT_EQ(vtk_numbers(text, "offsets"), (std::vector<double>{3, 6, 8}));
  EXPECT_EQ(vtk_numbers(text, "types"), (std::vector<double>{5, 5, 3}));
  EXPECT_EQ(vtk_numbers(text, "edge"), (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(vtk_numbers(text, "re_vv"), (std::vector<double>{1, 0, 2}));
  EXPECT_EQ(vtk_numbers(text, "im_vv"), (std::vector<double>{0.5, 0, 1}));
  EXPECT_EQ(vtk_numbers(text, "sigma_vv_dbsm")[1], -400.0);
}

TEST(ImageLattice, WaysAreCutWhereTheyLeaveACell) {
  const ImageLattice lattice = image_of(10, 10).lattice;  // from (-1, 2), cells of 0.1 x 0.2
  const std::vector<double> shares = lattice.crossings({-0.95, 2.1, 7.0}, {-0.75, 2.1, 3.0});
  ASSERT_EQ(shares.size(), 4u);
  EXPECT_NEAR(shares[1], 0.25, 1e-14);
  EXPECT_NEAR(shares[2], 0.75, 1e-14);
  EXPECT_EQ(lattice.crossings({-0.95, 2.1, 0.0}, {-0.95, 2.1, 1.0}).size(), 2u);  // along the line of sight
  EXPECT_EQ(lattice.at({-1.0 - 1e-15, 4.0 + 1e-15}), glm::uvec2(0, 9));           // rounding beside the rectangle
}

}  // namespace
}  // namespace raytube
