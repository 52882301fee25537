#include "mesh/model/edge_table.h"
#include "mesh/repair/winding.h"

namespace raytube {

namespace {

/// Floods the triangles across their edges.
class WindingFlood {
 public:
  explicit WindingFlood(const SeparateSoup& soup) : soup_(soup), edges_(soup.triangles, soup.vertex_of.size()) {
    found_.component.assign(soup.triangles.size(), no_index);
    found_.reversed.assign(soup.triangles.size(), false);
  }

  std::optional<Winding> run() {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (edges_[e].sides.size() > 2) return {};
    std::uint32_t components = 0;
    for (std::uint32_t t = 0; t < found_.component.size(); ++t)
      if (found_.component[t] == no_index && !flood(t, components++)) return {};
    list_border();
    return std::move(found_);
  }

 private:
  bool starts_low(const EdgeTable::Edge& edge, const EdgeTable::Side& side) const {
    return (soup_.triangles[side.triangle][side.corner] == edge.low) != found_.reversed[side.triangle];
  }

  /// False if the surface comes back to a triangle from its other side.
  bool flood(std::uint32_t first, std::uint32_t component) {
    found_.component[first] = component;
    waiting_.assign(1, first);
    while (!waiting_.empty()) {
      const std::uint32_t triangle = waiting_.back();
      waiting_.pop_back();
      for (int corner = 0; corner < 3; ++corner)
        if (!cross(edges_[edges_.edge_of(triangle, corner)])) return false;
    }
    return true;
  }

  bool cross(const EdgeTable::Edge& edge) {
    if (edge.sides.size() < 2) return true;
    const EdgeTable::Side &a = edge.sides[0], &b = edge.sides[1];
    const bool alike = starts_low(edge, a) != starts_low(edge, b);
    const bool a_is_new = found_.component[a.triangle] == no_index;
    if (!a_is_new && found_.component[b.triangle] != no_index) return alike;
    const auto [next, from] = a_is_new ? std::pair(a.triangle, b.triangle) : std::pair(b.triangle, a.triangle);
    found_.component[next] = found_.component[from];
    found_.reversed[next] = !alike;
    waiting_.push_back(next);
    return true;
  }

  void list_border() {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const EdgeTable::Edge edge = edges_[e];
      if (edge.sides.size() != 1) continue;
      const std::uint32_t low = soup_.vertex_of[edge.low], high = soup_.vertex_of[edge.high];
      const int sense = (low < high) == starts_low(edge, edge.sides[0]) ? -1 : 1;  // against that of the triangle
      found_.border.push_back({found_.component[edge.sides[0].triangle], std::min(low, high), std::max(low, high), sense});
    }
  }

  const SeparateSoup& soup_;
  EdgeTable edges_;
  Winding found_;
  std::vector<std::uint32_t> waiting_;
};

}  // namespace

std::optional<Winding> manifold_winding(const SeparateSoup& soup) { return WindingFlood(soup).run(); }

}  // namespace raytube
