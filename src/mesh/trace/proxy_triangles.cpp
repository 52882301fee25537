#include "mesh/trace/proxy_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

// A corner of a patch moves out by margin / sin(half its angle), by this many margins at most.
constexpr double longest_mitre = 60.0;
// A triangle lower than this fraction of its shortest side has a normal that single precision does not know, and so no depth.
constexpr double flattest = 0.1;
// Sine of the angle between the planes of two triangles: above it, a line that passes their common edge by and grazes one of them
// crosses the margin of the other one.
constexpr double sharp = 0.15;

// A corner of a patch: which way its edges there face, in the plane of the patch.
struct BorderCorner {
  dvec3 outwards[2];
  int edges = 0;

  void add(const dvec3& direction) {
    if (edges < 2) outwards[edges] = direction;
    ++edges;
  }

  // How a corner moves when its two edges move out by one; nothing if it is too sharp, or if more than two edges meet.
  std::optional<dvec3> move() const {
    if (edges != 2) return {};
    const dvec3 both = outwards[0] + outwards[1];
    const double square = glm::dot(both, both);  // 4 sin^2 of half the angle
    if (!(square * longest_mitre * longest_mitre > 4.0)) return {};
    return 2.0 / square * both;
  }
};

class Proxy {
 public:
  Proxy(const TriangleMesh& mesh, double margin)
      : mesh_(mesh), margin_(margin), edges_(mesh.edges()), place_(number_places()), border_corners_(places_) {
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (const EdgeTable::Side& side : edges_[e].sides)
        if (!mesh.is_inside_patch(edges_[e])) add_border(side);
    // Few edges have more than one strip, and pages that nothing is written to take no memory.
    all_.vertices.reserve(places_ + 4 * edges_.size());
    all_.triangles.reserve(mesh.triangles.size() + 2 * edges_.size());
    all_.source.reserve(all_.triangles.capacity());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) add_widened(t);
    decltype(border_corners_)().swap(border_corners_);  // twice as large as the mesh
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      if (is_flat(all_.triangles[t])) make_rectangle(t);
    for (std::size_t e = 0; e < edges_.size(); ++e) add_strips(edges_[e]);
  }

  ProxyTriangles all() { return std::move(all_); }

 private:
  void add_border(const EdgeTable::Side& side) {
    const dvec3 outwards = away_from(side);
    for (const std::uint32_t corner : {side.corner + 0u, (side.corner + 1u) % 3})
      border_corners_[place_[3 * std::size_t{side.triangle} + corner]].add(outwards);
  }

  // Away from the triangle in the plane of its patch: a thin one does not know its own, and would take a corner out of it.
  dvec3 away_from(const EdgeTable::Side& side) const {
    const Triangle& t = mesh_.triangles[side.triangle];
    const dvec3 along = mesh_.vertices[t[(side.corner + 1) % 3]] - mesh_.vertices[t[side.corner]];
    const bool turned = glm::dot(area_vector(mesh_.vertices, t), normal(side.triangle)) < 0.0;
    return glm::normalize(glm::cross(along, turned ? -normal(side.triangle) : normal(side.triangle)));
  }

  // A widened triangle has its places for corners, in the order in which they come.
  void add_widened(std::uint32_t triangle) {
    std::array<std::uint32_t, 3> corners;
    double moved = 0.0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const dvec3& vertex = mesh_.vertices[mesh_.triangles[triangle][k]];
      corners[k] = place_[3 * std::size_t{triangle} + k];
      if (corners[k] == all_.vertices.size()) {
        const std::optional<dvec3> move = border_corners_[corners[k]].move();
        all_.vertices.push_back(vertex + margin_ * move.value_or(dvec3(0.0)));
        stays_.push_back(!move);
      }
      moved = std::max(moved, glm::distance(all_.vertices[corners[k]], vertex));
    }
    all_.triangles.push_back(corners);
    all_.source.push_back(triangle);
    all_.moved.push_back(moved);
  }

  void add_strips(const EdgeTable::Edge& edge) {
    if (mesh_.is_inside_patch(edge)) return;
    for (const EdgeTable::Side& side : edge.sides) {
      const auto stays = [&](std::uint32_t corner) { return stays_[place_[3 * std::size_t{side.triangle} + corner % 3]]; };
      if (stays(side.corner) || stays(side.corner + 1)) add_strip(edge, side.triangle, away_from(side));
    }
    if (is_almost_flat(edge)) add_strip(edge, edge.sides[0].triangle, normal(edge.sides[0].triangle));
  }

  bool is_flat(const Triangle& t) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) shortest = std::min(shortest, glm::distance(all_.vertices[t[k]], all_.vertices[t[(k + 1) % 3]]));
    return height(all_.vertices, t) < flattest * shortest;
  }

  // Instead of a widened triangle the rectangle along its longest side that holds it: two triangles with a short side each. One
  // that held the triangle of the mesh would leave a gap to neighbours whose common corner has moved.
  void make_rectangle(std::uint32_t triangle) {
    const Triangle t = all_.triangles[triangle];
    const int k = longest_edge(all_.vertices, t);
    const dvec3 from = all_.vertices[t[k]], to = all_.vertices[t[(k + 1) % 3]], third = all_.vertices[t[(k + 2) % 3]];
    const dvec3 along = glm::normalize(to - from), across = glm::normalize(glm::cross(normal(triangle), along));
    const double top = glm::dot(third - from, across);
    const dvec3 low = (std::min(top, 0.0) - margin_) * across, high = (std::max(top, 0.0) + margin_) * across;
    const dvec3 beyond = margin_ * along;
    const std::uint32_t first = add_quadrangle(from - beyond + low, to + beyond + low, to + beyond + high, from - beyond + high);
    all_.triangles[triangle] = {first, first + 1, first + 2};
    all_.triangles.push_back({first, first + 2, first + 3});
    all_.source.push_back(triangle);
    all_.moved[triangle] = std::numeric_limits<double>::infinity();
  }

  // The number of its first vertex.
  std::uint32_t add_quadrangle(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
    const auto first = static_cast<std::uint32_t>(all_.vertices.size());
    all_.vertices.insert(all_.vertices.end(), {a, b, c, d});
    return first;
  }

  bool is_almost_flat(const EdgeTable::Edge& edge) const {
    return std::ranges::all_of(edge.sides, [&](const EdgeTable::Side& side) {
      return glm::length(glm::cross(normal(edge.sides[0].triangle), normal(side.triangle))) < sharp;
    });
  }

  // Along an edge and beyond its ends, by the margin to both sides.
  void add_strip(const EdgeTable::Edge& edge, std::uint32_t source, const dvec3& across) {
    const dvec3 low = mesh_.vertices[edge.low], high = mesh_.vertices[edge.high];
    const dvec3 beyond = margin_ * glm::normalize(high - low), aside = margin_ * across;
    const std::uint32_t first =
        add_quadrangle(low - beyond - aside, high + beyond - aside, high + beyond + aside, low - beyond + aside);
    all_.triangles.insert(all_.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
    all_.source.insert(all_.source.end(), 2, source);
  }

  // A number for each vertex as a corner of a patch, for all corners of triangles, in the order in which they come.
  std::vector<std::uint32_t> number_places() {
    std::vector<std::uint32_t> first = first_corners();
    for (std::uint32_t corner = 0; corner < first.size(); ++corner)
      first[corner] = first[corner] == corner ? places_++ : first[first[corner]];
    return first;
  }

  // Of each corner of each triangle the first one at its vertex in its patch.
  std::vector<std::uint32_t> first_corners() const {
    std::vector<std::uint32_t> first(3 * mesh_.triangles.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;  // patch, corner
    for (std::uint32_t vertex = 0; vertex < mesh_.vertices.size(); ++vertex) {
      corners.clear();
      for (const std::uint32_t t : mesh_.at_vertex()[vertex]) {
        corners.emplace_back(patch(t), 3 * t + corner_at(mesh_.triangles[t], vertex));
      }
      std::ranges::sort(corners);
      for (std::size_t i = 0; i < corners.size(); ++i)
        first[corners[i].second] =
            i > 0 && corners[i].first == corners[i - 1].first ? first[corners[i - 1].second] : corners[i].second;
    }
    return first;
  }

  std::uint32_t patch(std::uint32_t triangle) const { return mesh_.triangle_patch[triangle]; }
  const dvec3& normal(std::uint32_t triangle) const { return mesh_.patches[patch(triangle)].normal; }

  const TriangleMesh& mesh_;
  double margin_;
  const EdgeTable& edges_;
  std::uint32_t places_ = 0;
  std::vector<std::uint32_t> place_;          // of each corner of each triangle
  std::vector<BorderCorner> border_corners_;  // by place
  std::vector<bool> stays_;                   // by place
  ProxyTriangles all_;
};

}  // namespace

ProxyTriangles proxy_triangles(const TriangleMesh& mesh, double margin) { return Proxy(mesh, margin).all(); }

}  // namespace raytube
