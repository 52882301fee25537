#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>

#include "mesh/repair/winding.h"

namespace raytube {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

/// Takes note of what CGAL does to the soup.
struct Recorder : PMP::Default_orientation_visitor {
  std::vector<std::uint32_t>* vertex_of = nullptr;
  std::vector<bool>* reversed = nullptr;
  void polygon_orientation_reversed(std::size_t triangle) { (*reversed)[triangle] = !(*reversed)[triangle]; }
  void duplicated_vertex(std::size_t original, std::size_t) { vertex_of->push_back((*vertex_of)[original]); }
};

}  // namespace

std::vector<bool> cut_and_wind(std::span<const dvec3> vertices, SeparateSoup& soup) {
  std::vector<dvec3> points;  // CGAL only copies them
  for (const std::uint32_t v : soup.vertex_of) points.push_back(vertices[v]);
  std::vector<bool> reversed(soup.triangles.size(), false);
  Recorder recorder;
  recorder.vertex_of = &soup.vertex_of;
  recorder.reversed = &reversed;
  PMP::orient_polygon_soup(points, soup.triangles, CGAL::parameters::visitor(recorder));
  return reversed;
}

}  // namespace raytube
