#include "mesh/repair/build_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "mesh/model/edge_table.h"
#include "mesh/repair/steps.h"
#include "mesh/repair/triangulate.h"

namespace raytube {

namespace {

/// Leaves out the points that no corner uses, so that they cannot move or stretch the bounding box.
template <class Polygons>
void drop_unused_points(std::vector<dvec3>& points, Polygons& polygons) {
  std::vector<std::uint32_t> number(points.size(), no_index);
  for (const auto& polygon : polygons)
    for (const std::uint32_t corner : polygon) number[corner] = 0;
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] == no_index) continue;
    number[i] = kept;
    points[kept++] = points[i];
  }
  points.resize(kept);
  for (auto& polygon : polygons)
    for (std::uint32_t& corner : polygon) corner = number[corner];
}

/// Moves the bounding box's middle to the origin, then scales to metres; returns the middle [m]. The difference of nearby
/// numbers is exact, so a target far from its origin loses nothing here.
dvec3 recentre(std::vector<dvec3>& points, double metres_per_unit) {
  const dvec3 middle = bounding_box(points).middle();
  for (dvec3& p : points) p = (p - middle) * metres_per_unit;
  return middle * metres_per_unit;
}

/// Most polygons are, and need no list of pieces.
bool is_triangle(std::span<const std::uint32_t> corners) {
  return corners.size() == 3 && corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

Facets split_polygons(const PolygonSoup& soup, MeshReport& report) {
  Facets facets;
  facets.triangles.reserve(soup.polygons.size());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    const std::vector<std::uint32_t>& corners = soup.polygons[i];
    if (is_triangle(corners)) {
      facets.triangles.push_back({corners[0], corners[1], corners[2]});
    } else {
      const std::vector<Triangle> pieces = triangulate(soup.points, corners);
      if (pieces.empty()) ++report.facets_unusable;
      facets.triangles.insert(facets.triangles.end(), pieces.begin(), pieces.end());
    }
    if (!soup.materials.empty()) facets.materials.resize(facets.triangles.size(), soup.materials[i]);
    if (!soup.parts.empty()) facets.parts.resize(facets.triangles.size(), soup.parts[i]);
  }
  return facets;
}

void join_corners(Facets& facets, std::span<const std::uint32_t> vertex_of_point, MeshReport& report) {
  for (Triangle& t : facets.triangles)
    for (std::uint32_t& corner : t) corner = vertex_of_point[corner];
  report.triangles_degenerate += facets.drop_if([&](std::size_t i) {
    const Triangle& t = facets.triangles[i];
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  });
}

struct EdgeCount {
  std::uint64_t open = 0, non_manifold = 0, badly_wound = 0;
};

EdgeCount count_edges(const EdgeTable& edges, std::span<const Triangle> triangles) {
  const auto starts_low = [&](const EdgeTable::Edge& edge, int i) {
    return triangles[edge.sides[i].triangle][edge.sides[i].corner] == edge.low;
  };
  EdgeCount count;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeTable::Edge edge = edges[e];
    count.open += edge.sides.size() == 1;
    count.non_manifold += edge.sides.size() > 2;
    count.badly_wound += edge.sides.size() == 2 && starts_low(edge, 0) == starts_low(edge, 1);
  }
  return count;
}

/// The mesh's state before it is mended, for comparison with other programs, which leave out facets without area.
void report_as_read(std::span<const dvec3> vertices, std::span<const Triangle> triangles, MeshReport& report) {
  std::vector<Triangle> solid;
  const double rounding = 1e-3 * report.weld_distance;
  std::ranges::copy_if(triangles, std::back_inserter(solid), [&](const Triangle& t) { return height(vertices, t) > rounding; });
  const EdgeCount count = count_edges(EdgeTable(solid, vertices.size()), solid);
  report.open_edges_read = count.open;
  report.non_manifold_edges_read = count.non_manifold;
  report.badly_wound_edges_read = count.badly_wound;
}

/// What waves enter has two exposed sides.
void open_penetrable_components(TriangleMesh& mesh, const Facets& facets, std::span<const Material> materials,
                                MeshReport& report) {
  for (std::uint32_t t = 0; t < mesh.triangle_component.size(); ++t) {
    if (!transmits(materials, facets.material(t)) || !mesh.closed(t)) continue;
    Component& component = mesh.components[mesh.triangle_component[t]];
    component.closed = false;
    component.penetrable = true;
    ++report.components_penetrable;
  }
}

void report_as_traced(const TriangleMesh& mesh, MeshReport& report) {
  const EdgeCount count = count_edges(mesh.edges(), mesh.triangles);
  report.open_edges = count.open;
  report.non_manifold_edges = count.non_manifold;
  report.triangles_traced = mesh.triangles.size();
  report.components = mesh.components.size();
  report.components_closed = std::ranges::count(mesh.components, true, &Component::closed);
  report.patches = mesh.patches.size();
}

[[noreturn]] void reject_without_area(const std::string& name) {
  throw InputError(fmt::format("mesh file '{}': no facet has an area; export the surface again", name));
}

// An atom is a tenth of a nanometre: nothing smaller has a surface. And no coordinate may lie farther off than other places do.
constexpr double smallest_target = 1e-9, farthest_target = 1e12;  // [m]

void check_size(const std::string& name, const Box& box, const dvec3& center) {
  if (!(std::isfinite(box.diagonal()) && glm::length(center) + box.diagonal() < farthest_target))
    throw InputError(fmt::format("mesh file '{}': coordinates are too large; check target.unit", name));
  const dvec3 sides = box.high - box.low;
  const double longest = std::max({sides.x, sides.y, sides.z});  // whose square may be 0
  if (longest > 0.0 && longest < smallest_target)
    throw InputError(
        fmt::format("mesh file '{}': the target is {:.3g} m across, less than {:g} m, and no surface is as small as "
                    "that; check target.unit and the coordinates",
                    name, longest, smallest_target));
  if (longest == 0.0) reject_without_area(name);
}

}  // namespace

LoadedMesh build_mesh(PolygonSoup soup, double metres_per_unit, const std::string& name, std::span<const Material> materials) {
  LoadedMesh loaded;
  auto& [mesh, report] = loaded;
  report.facets_read = soup.polygons.size();
  report.vertices_read = soup.points.size();
  report.free_forms_read = soup.free_forms;
  report.further_files = soup.further_files;
  report.coordinate_step = soup.step.value_or(0.0) * metres_per_unit;
  report.remarks = soup.remarks;

  drop_unused_points(soup.points, soup.polygons);
  mesh.center = recentre(soup.points, metres_per_unit);
  if (soup.points.empty()) reject_without_area(name);
  const Box box = bounding_box(soup.points);
  check_size(name, box, mesh.center);
  const double diagonal = box.diagonal();
  report.weld_distance = weld_fraction * diagonal;

  Facets facets = split_polygons(soup, report);
  soup.polygons = {};  // they take more memory than all that is made of them here
  report.triangles_read = facets.triangles.size();
  WeldedPoints welded = weld(soup.points, report.weld_distance, diagonal);
  report.vertices_welded = soup.points.size() - welded.vertices.size();
  mesh.vertices = std::move(welded.vertices);
  join_corners(facets, welded.vertex_of_point, report);
  report_as_read(mesh.vertices, facets.triangles, report);
  const EdgeTable edges = make_conforming(mesh.vertices, facets, report.weld_distance, report);
  align_coincident_faces(mesh.vertices, edges, report.weld_distance, facets, report);
  drop_duplicates(facets, materials, mesh.vertices.size(), report);
  if (facets.triangles.empty()) reject_without_area(name);

  drop_unused_points(mesh.vertices, facets.triangles);
  Surfaces surfaces = orient(mesh.vertices, facets.triangles, report.weld_distance, report);
  mesh.triangle_component = std::move(surfaces.triangle_component);
  mesh.components = std::move(surfaces.components);
  open_penetrable_components(mesh, facets, materials, report);
  mesh.triangles = std::move(facets.triangles);
  mesh.triangle_part = std::move(facets.parts), mesh.part_names = std::move(soup.part_names);
  mesh.coordinate_step = report.coordinate_step;
  find_patches(mesh, flat_fraction * diagonal, facets.materials);
  for (const dvec3& v : mesh.vertices) mesh.radius = std::max(mesh.radius, glm::length(v));
  report_as_traced(mesh, report);
  return loaded;
}

}  // namespace raytube
