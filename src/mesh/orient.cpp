#include "mesh/orient.h"

#define _USE_MATH_DEFINES  // OpenMesh asks for it
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
//
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <algorithm>

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

CutSoup wind_alike(std::span<const dvec3> vertices, std::span<const Triangle> triangles) {
  CutSoup soup;
  soup.reversed.assign(triangles.size(), false);
  for (const Triangle& t : triangles) soup.triangles.push_back({t[0], t[1], t[2]});
  for (std::uint32_t v = 0; v < vertices.size(); ++v) soup.vertex.push_back(v);
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  for (const dvec3& p : vertices) points.emplace_back(p.x, p.y, p.z);
  Recorder recorder;
  recorder.soup = &soup;
  PMP::orient_polygon_soup(points, soup.triangles, CGAL::parameters::visitor(recorder));
  return soup;
}

/// Adds the triangles in order, so that face numbers are triangle numbers. OpenMesh refuses a triangle it cannot attach;
/// CGAL's cuts leave none, but should there be one it gets corners of its own rather than be lost.
HalfedgeMesh halfedge_mesh(std::span<const dvec3> vertices, CutSoup& soup) {
  HalfedgeMesh mesh;
  mesh.reserve(soup.vertex.size(), soup.triangles.size() * 3 / 2, soup.triangles.size());
  const auto add_vertex = [&](std::uint32_t v) { return mesh.add_vertex({vertices[v].x, vertices[v].y, vertices[v].z}); };
  for (const std::uint32_t v : soup.vertex) add_vertex(v);
  for (const auto& t : soup.triangles) {
    std::array<HalfedgeMesh::VertexHandle, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = mesh.vertex_handle(static_cast<unsigned>(t[k]));
    if (mesh.add_face(corners.data(), 3).is_valid()) continue;
    for (int k = 0; k < 3; ++k) {
      soup.vertex.push_back(soup.vertex[t[k]]);
      corners[k] = add_vertex(soup.vertex.back());
    }
    mesh.add_face(corners.data(), 3);
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

/// A border halfedge in the mesh's own vertices; `sense` is +1 from low to high, -1 the other way.
struct BorderPiece {
  std::uint32_t component, low, high;
  int sense;
  auto key() const { return std::tie(component, low, high); }
};

std::vector<BorderPiece> border_pieces(const HalfedgeMesh& mesh, const CutSoup& soup, std::span<const std::uint32_t> component) {
  std::vector<BorderPiece> pieces;
  for (const auto edge : mesh.halfedges()) {
    if (!mesh.is_boundary(edge)) continue;
    const std::uint32_t from = soup.vertex[mesh.from_vertex_handle(edge).idx()];
    const std::uint32_t to = soup.vertex[mesh.to_vertex_handle(edge).idx()];
    const int face = mesh.face_handle(mesh.opposite_halfedge_handle(edge)).idx();
    pieces.push_back({component[face], std::min(from, to), std::max(from, to), from < to ? 1 : -1});
  }
  std::sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.key() < b.key(); });
  return pieces;
}

/// Components whose border does not cancel. The slit that a fin cuts into a box does: its two lips run in opposite senses.
std::vector<bool> have_border(std::span<const BorderPiece> pieces, std::size_t components) {
  std::vector<bool> open(components, false);
  for (std::size_t i = 0; i < pieces.size();) {
    int sum = 0;
    std::size_t end = i;
    for (; end < pieces.size() && pieces[end].key() == pieces[i].key(); ++end) sum += pieces[end].sense;
    if (sum != 0) open[pieces[i].component] = true;
    i = end;
  }
  return open;
}

/// What decides a component's winding.
struct Totals {
  double volume = 0.0;  // six times the enclosed one
  double area = 0.0;    // twice
  std::uint64_t reversed = 0;
  std::uint64_t triangles = 0;
  bool first_reversed = false;
};

std::vector<Totals> total_up(std::span<const dvec3> vertices, std::span<const Triangle> triangles, const CutSoup& soup,
                             std::span<const std::uint32_t> component, std::size_t components) {
  std::vector<Totals> totals(components);
  std::vector<dvec3> origin(components);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Totals& total = totals[component[i]];
    dvec3& apex = origin[component[i]];
    if (total.triangles++ == 0) {
      total.first_reversed = soup.reversed[i];
      apex = vertices[triangles[i][0]];
    }
    const dvec3 area = area_vector(vertices, triangles[i]) * (soup.reversed[i] ? -1.0 : 1.0);
    total.volume += glm::dot(vertices[triangles[i][0]] - apex, area);
    total.area += glm::length(area);
    total.reversed += soup.reversed[i];
  }
  return totals;
}

/// True if CGAL's winding of an open component is not that of most of its triangles; the first one decides a tie.
bool against_majority(const Totals& total) {
  const std::uint64_t others = total.triangles - total.reversed;
  return total.reversed > others || (total.reversed == others && total.first_reversed);
}

}  // namespace

Surfaces orient(std::span<const dvec3> vertices, std::vector<Triangle>& triangles, double distance, MeshReport& report) {
  CutSoup soup = wind_alike(vertices, triangles);
  HalfedgeMesh mesh = halfedge_mesh(vertices, soup);
  Surfaces surfaces{number_components(mesh), {}};
  const auto& component = surfaces.triangle_component;
  const std::size_t components = component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
  const std::vector<bool> open = have_border(border_pieces(mesh, soup, component), components);
  const std::vector<Totals> totals = total_up(vertices, triangles, soup, component, components);

  std::vector<bool> turn(components);
  for (std::size_t c = 0; c < components; ++c) {
    const double thickness = std::abs(totals[c].volume) / 3.0 / (0.5 * totals[c].area);  // as of a closed flat box
    const bool closed = !open[c] && thickness > distance;
    turn[c] = closed ? totals[c].volume < 0.0 : against_majority(totals[c]);
    surfaces.components.push_back({closed, static_cast<std::uint32_t>(totals[c].triangles)});
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (soup.reversed[i] == turn[component[i]]) continue;
    std::swap(triangles[i][1], triangles[i][2]);
    ++report.triangles_flipped;
  }
  return surfaces;
}

}  // namespace raytube
