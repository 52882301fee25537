#include "mesh/repair/winding.h"

#define _USE_MATH_DEFINES  // OpenMesh asks for it
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
//
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <algorithm>

#include "mesh/model/edge_table.h"

namespace raytube {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

/// The triangles cut apart at edges where they cannot be one manifold; `vertex` leads from a copy back to the mesh's vertex.
struct CutSoup {
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::uint32_t> vertex;
  std::vector<bool> reversed;
};

/// Takes note of what CGAL does to the soup.
struct Recorder : PMP::Default_orientation_visitor {
  CutSoup* soup = nullptr;
  void polygon_orientation_reversed(std::size_t triangle) { soup->reversed[triangle] = !soup->reversed[triangle]; }
  void duplicated_vertex(std::size_t original, std::size_t) { soup->vertex.push_back(soup->vertex[original]); }
};

CutSoup wind_alike(std::span<const dvec3> vertices, const SeparateSoup& separate) {
  CutSoup soup{{}, separate.vertex_of, std::vector<bool>(separate.triangles.size(), false)};
  for (const Triangle& t : separate.triangles) soup.triangles.push_back({t[0], t[1], t[2]});
  std::vector<dvec3> points;  // CGAL only copies them
  for (const std::uint32_t v : soup.vertex) points.push_back(vertices[v]);
  Recorder recorder;
  recorder.soup = &soup;
  PMP::orient_polygon_soup(points, soup.triangles, CGAL::parameters::visitor(recorder));
  return soup;
}

/// Of each triangle's three sides.
std::vector<HalfedgeMesh::HalfedgeHandle> add_edges(HalfedgeMesh& mesh, const CutSoup& soup) {
  std::vector<Triangle> triangles;
  for (const auto& t : soup.triangles)
    triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]), static_cast<std::uint32_t>(t[2])});
  const EdgeTable edges(triangles, soup.vertex.size());
  std::vector<HalfedgeMesh::HalfedgeHandle> sides(3 * triangles.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto from = [&](const EdgeTable::Side& side) { return triangles[side.triangle][side.corner]; };
    const std::span<const EdgeTable::Side> of = edges[e].sides;
    const bool paired = of.size() == 2 && from(of[0]) != from(of[1]);
    for (const EdgeTable::Side& side : of) {
      const bool second = paired && &side != &of[0];
      const auto start = mesh.vertex_handle(from(side)),
                 end = mesh.vertex_handle(triangles[side.triangle][(side.corner + 1) % 3]);
      sides[3 * side.triangle + side.corner] =
          second ? mesh.opposite_halfedge_handle(sides[3 * of[0].triangle + of[0].corner]) : mesh.new_edge(start, end);
    }
  }
  return sides;
}

/// The triangles in order, so that face numbers are triangle numbers. The links are set by hand: to find an edge, OpenMesh walks
/// round a vertex, which may have a hundred thousand. Where a side has no partner that runs the other way it is a border (CGAL's
/// cuts leave no edge of more than two sides); borders are not linked among one another.
HalfedgeMesh halfedge_mesh(std::span<const dvec3> vertices, const CutSoup& soup) {
  HalfedgeMesh mesh;
  mesh.reserve(soup.vertex.size(), soup.triangles.size() * 3 / 2, soup.triangles.size());
  for (const std::uint32_t v : soup.vertex) mesh.add_vertex({vertices[v].x, vertices[v].y, vertices[v].z});
  const std::vector<HalfedgeMesh::HalfedgeHandle> sides = add_edges(mesh, soup);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto face = mesh.new_face();
    mesh.set_halfedge_handle(face, sides[3 * t]);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.set_face_handle(sides[3 * t + k], face);
      mesh.set_next_halfedge_handle(sides[3 * t + k], sides[3 * t + (k + 1) % 3]);
    }
  }
  return mesh;
}

std::vector<std::uint32_t> number_components(HalfedgeMesh& mesh) {
  const auto number = get(CGAL::dynamic_face_property_t<std::size_t>(), mesh);
  PMP::connected_components(mesh, number);
  std::vector<std::uint32_t> component;
  for (const auto face : mesh.faces()) component.push_back(static_cast<std::uint32_t>(get(number, face)));
  return component;
}

std::vector<BorderPiece> border_pieces(const HalfedgeMesh& mesh, const CutSoup& soup, std::span<const std::uint32_t> component) {
  std::vector<BorderPiece> pieces;
  for (const auto edge : mesh.halfedges()) {
    if (!mesh.is_boundary(edge)) continue;
    const std::uint32_t from = soup.vertex[mesh.from_vertex_handle(edge).idx()];
    const std::uint32_t to = soup.vertex[mesh.to_vertex_handle(edge).idx()];
    const int face = mesh.face_handle(mesh.opposite_halfedge_handle(edge)).idx();
    pieces.push_back({component[face], std::min(from, to), std::max(from, to), from < to ? 1 : -1});
  }
  return pieces;
}

}  // namespace

Winding cut_winding(std::span<const dvec3> vertices, const SeparateSoup& separate) {
  CutSoup soup = wind_alike(vertices, separate);
  HalfedgeMesh mesh = halfedge_mesh(vertices, soup);
  Winding winding{number_components(mesh), {}, {}};
  winding.border = border_pieces(mesh, soup, winding.component);
  winding.reversed = std::move(soup.reversed);
  return winding;
}

}  // namespace raytube
