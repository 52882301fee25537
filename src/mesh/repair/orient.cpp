#include "mesh/repair/orient.h"

#define _USE_MATH_DEFINES  // OpenMesh asks for it
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
//
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <algorithm>
#include <numeric>

#include "mesh/model/edge_table.h"
#include "mesh/repair/separate.h"

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

/// Length of each component's border that does not cancel. The slit that a fin cuts into a box does: its two lips run in
/// opposite senses.
std::vector<double> border_lengths(std::span<const dvec3> vertices, std::span<const BorderPiece> pieces, std::size_t components) {
  std::vector<double> length(components, 0.0);
  for (std::size_t i = 0; i < pieces.size();) {
    int sum = 0;
    std::size_t end = i;
    for (; end < pieces.size() && pieces[end].key() == pieces[i].key(); ++end) sum += pieces[end].sense;
    if (sum != 0) length[pieces[i].component] += glm::distance(vertices[pieces[i].low], vertices[pieces[i].high]);
    i = end;
  }
  return length;
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

/// The components of a soup, whether they are closed, and which triangles are to be turned over.
struct Analysis {
  std::vector<std::uint32_t> component;
  std::vector<bool> closed;
  std::vector<bool> nearly_closed;
  std::vector<bool> turned;
};

/// A border of this length bounds no hole larger than border^2 / 4 pi: small against the area, it is a gap in a body. The
/// border of an open surface is not, however finely the surface is meshed.
bool only_a_gap(double border, double area) { return border > 0.0 && border * border / (4.0 * pi) < 0.02 * area; }

Analysis analyse(std::span<const dvec3> vertices, std::span<const Triangle> triangles, const SeparateSoup& separate,
                 double distance) {
  const CutSoup soup = wind_alike(vertices, separate);
  HalfedgeMesh mesh = halfedge_mesh(vertices, soup);
  Analysis analysis{number_components(mesh), {}, {}, {}};
  const auto& component = analysis.component;
  const std::size_t components = component.empty() ? 0 : *std::ranges::max_element(component) + 1;
  const std::vector<double> border = border_lengths(vertices, border_pieces(mesh, soup, component), components);
  const std::vector<Totals> totals = total_up(vertices, triangles, soup, component, components);

  std::vector<bool> turn(components);
  for (std::size_t c = 0; c < components; ++c) {
    const double thickness = std::abs(totals[c].volume) / 3.0 / (0.5 * totals[c].area);  // as of a closed flat box
    analysis.closed.push_back(border[c] == 0.0 && thickness > distance);
    analysis.nearly_closed.push_back(only_a_gap(border[c], 0.5 * totals[c].area));
    turn[c] = analysis.closed[c] ? totals[c].volume < 0.0 : against_majority(totals[c]);
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) analysis.turned.push_back(soup.reversed[i] != turn[component[i]]);
  return analysis;
}

SeparateSoup as_it_is(std::span<const dvec3> vertices, std::span<const Triangle> triangles) {
  SeparateSoup soup{{triangles.begin(), triangles.end()}, std::vector<std::uint32_t>(vertices.size())};
  std::iota(soup.vertex_of.begin(), soup.vertex_of.end(), 0u);
  return soup;
}

bool has_non_manifold_edge(std::span<const Triangle> triangles, std::size_t vertex_count) {
  const EdgeTable edges(triangles, vertex_count);
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].sides.size() > 2) return true;
  return false;
}

/// Bodies that touch along edges fall to pieces when cut there. Tries the open pieces again as bodies, by their winding as
/// read, and takes over what is closed then.
void rejoin_touching_bodies(std::span<const dvec3> vertices, std::span<const Triangle> triangles, double distance,
                            Analysis& analysis) {
  std::vector<std::uint32_t> index;
  std::vector<Triangle> open;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (analysis.closed[analysis.component[i]]) continue;
    index.push_back(i);
    open.push_back(triangles[i]);
  }
  if (!has_non_manifold_edge(open, vertices.size())) return;
  const Analysis again = analyse(vertices, open, separate_bodies(vertices, open), distance);
  const auto offset = static_cast<std::uint32_t>(analysis.closed.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (!again.closed[again.component[i]]) continue;
    analysis.component[index[i]] = offset + again.component[i];
    analysis.turned[index[i]] = again.turned[i];
  }
  analysis.closed.insert(analysis.closed.end(), again.closed.begin(), again.closed.end());
  analysis.nearly_closed.resize(analysis.closed.size(), false);  // taken over only where closed
}

Surfaces number_in_order(const Analysis& analysis, MeshReport& report) {
  Surfaces surfaces;
  std::vector<std::uint32_t> number(analysis.closed.size(), no_index);
  for (const std::uint32_t c : analysis.component) {
    if (number[c] == no_index) {
      number[c] = static_cast<std::uint32_t>(surfaces.components.size());
      surfaces.components.push_back({analysis.closed[c], 0});
      report.components_nearly_closed += analysis.nearly_closed[c];
    }
    ++surfaces.components[number[c]].triangles;
    surfaces.triangle_component.push_back(number[c]);
  }
  return surfaces;
}

}  // namespace

Surfaces orient(std::span<const dvec3> vertices, std::vector<Triangle>& triangles, double distance, MeshReport& report) {
  Analysis analysis = analyse(vertices, triangles, as_it_is(vertices, triangles), distance);
  if (std::ranges::count(analysis.closed, false) > 1) rejoin_touching_bodies(vertices, triangles, distance, analysis);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!analysis.turned[i]) continue;
    std::swap(triangles[i][1], triangles[i][2]);
    ++report.triangles_flipped;
  }
  return number_in_order(analysis, report);
}

}  // namespace raytube
