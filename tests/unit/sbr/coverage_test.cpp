// Cells that no ray can use.
#include <gtest/gtest.h>

#include "sbr/flat/coverage.h"
#include "shapes.h"

namespace raytube {
namespace {

// Single rays say what is covered: every cell that meets the target is marked, and few others are.
void expect_covers(const PolygonSoup& soup, const Direction& look, double per_wavelength) {
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const Tracer tracer(loaded.mesh);
  const FaceTree faces(loaded.mesh);
  const LaunchGrid grid = launch_grid(loaded.mesh, look, 0.1, per_wavelength, std::nullopt);
  const CellBlock tile{grid.columns / 5, grid.columns, 0, grid.rows - grid.rows / 7};
  const Coverage coverage(&faces, grid, tile);
  std::vector<Ray> rays;
  for (std::uint32_t row = tile.row_begin; row < tile.row_end; ++row)
    for (std::uint32_t column = tile.column_begin; column < tile.column_end; ++column) rays.push_back(grid.ray(column, row));
  std::vector<Hit> hits(rays.size());
  tracer.closest_hits(rays, hits);
  std::uint64_t missed = 0, empty = 0, i = 0;
  for (std::uint32_t row = tile.row_begin; row < tile.row_end; ++row) {
    Coverage::Span span{0, 0};
    for (std::uint32_t column = tile.column_begin; column < tile.column_end; ++column, ++i) {
      if (column >= span.end) span = coverage.next(row, column);
      const bool covered = column >= span.begin && column < span.end;
      EXPECT_TRUE(!hits[i] || covered) << column << ", " << row;
      missed += hits[i] ? 0 : 1;
      empty += covered ? 0 : 1;
    }
  }
  EXPECT_GT(missed, rays.size() / 20);
  EXPECT_EQ(empty, missed);  // no ray runs within 1e-9 of an outline here
  EXPECT_EQ(coverage.empty_cells(), empty);
}

TEST(Coverage, IsWhatRaysMeet) {
  for (const Direction& look : {Direction{0.7, 0.4}, Direction{1.2, 2.0}, Direction{2.6, 5.0}}) {
    expect_covers(shapes::plate(1.0, 0.5), look, 10.0);
    expect_covers(shapes::trihedral(1.0), look, 13.0);
    expect_covers(shapes::cube(0.8), look, 10.0);
    expect_covers(shapes::icosphere(1, 0.5), look, 20.0);
  }
}

TEST(Coverage, DenseMeshesAreLeftToTheRays) {
  const LoadedMesh loaded = build_mesh(shapes::icosphere(4, 0.5), 1.0);
  const LaunchGrid grid = launch_grid(loaded.mesh, {0.7, 0.4}, 0.1, 2.0, std::nullopt);
  const FaceTree faces(loaded.mesh);
  const CellBlock tile{0, grid.columns, 0, grid.rows};
  const Coverage coverage(&faces, grid, tile);
  EXPECT_EQ(coverage.empty_cells(), 0u);
  EXPECT_EQ(coverage.next(1, 2).begin, 2u);
  EXPECT_EQ(coverage.next(1, 2).end, grid.columns);
  EXPECT_EQ(Coverage(nullptr, grid, tile).empty_cells(), 0u);
}

}  // namespace
}  // namespace raytube
