#include <algorithm>
#include <numeric>

#include "mesh/model/edge_table.h"
#include "mesh/repair/steps.h"
#include "mesh/repair/winding.h"

namespace raytube {

namespace {

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

std::vector<Totals> total_up(std::span<const dvec3> vertices, std::span<const Triangle> triangles, const Winding& winding,
                             std::size_t components) {
  std::vector<Totals> totals(components);
  std::vector<dvec3> origin(components);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Totals& total = totals[winding.component[i]];
    dvec3& apex = origin[winding.component[i]];
    if (total.triangles++ == 0) {
      total.first_reversed = winding.reversed[i];
      apex = vertices[triangles[i][0]];
    }
    const dvec3 area = area_vector(vertices, triangles[i]) * (winding.reversed[i] ? -1.0 : 1.0);
    total.volume += glm::dot(vertices[triangles[i][0]] - apex, area);
    total.area += glm::length(area);
    total.reversed += winding.reversed[i];
  }
  return totals;
}

/// True if the winding of an open component is not that of most of its triangles; the first one decides a tie.
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
  Winding winding = wind_alike(vertices, separate);
  const auto& component = winding.component;
  const std::size_t components = component.empty() ? 0 : *std::ranges::max_element(component) + 1;
  std::ranges::sort(winding.border, {}, &BorderPiece::key);
  const std::vector<double> border = border_lengths(vertices, winding.border, components);
  const std::vector<Totals> totals = total_up(vertices, triangles, winding, components);

  Analysis analysis;
  std::vector<bool> turn(components);
  for (std::size_t c = 0; c < components; ++c) {
    const double thickness = std::abs(totals[c].volume) / 3.0 / (0.5 * totals[c].area);  // as of a closed flat box
    analysis.closed.push_back(border[c] == 0.0 && thickness > distance);
    analysis.nearly_closed.push_back(only_a_gap(border[c], 0.5 * totals[c].area));
    turn[c] = analysis.closed[c] ? totals[c].volume < 0.0 : against_majority(totals[c]);
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) analysis.turned.push_back(winding.reversed[i] != turn[component[i]]);
  analysis.component = std::move(winding.component);
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
