#include "mesh_file.h"

#include "mesh/repair/build_mesh.h"

namespace raytube::fuzz {

namespace {

// More corners than that are read, but not built: what a reader gets wrong shows in the soup, and building takes its time.
constexpr std::size_t most_corners = 400;

std::size_t check_corners(const PolygonSoup& soup) {
  std::size_t corners = 0;
  for (const auto& polygon : soup.polygons) {
    corners += polygon.size();
    for (const std::uint32_t corner : polygon) expect(corner < soup.points.size(), "a corner is one of the vertices");
  }
  return corners;
}

void check_account(const MeshReport& report) {
  expect(report.triangles_read + report.triangles_added ==
             report.triangles_traced + report.triangles_degenerate + report.triangles_duplicate + report.triangles_internal,
         "every facet is traced or reported");
}

}  // namespace

int read_mesh(MeshParser parse, const std::uint8_t* data, std::size_t size) {
  try {
    PolygonSoup soup = read_polygon_soup({"mesh", text_of(data, size)}, parse);
    if (check_corners(soup) <= most_corners) check_account(build_mesh(std::move(soup), 1e-3).report);
  } catch (const InputError& error) {
    expect_sentence(error.what());
  }
  return 0;
}

}  // namespace raytube::fuzz
