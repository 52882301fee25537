#include "mesh/model/faces.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

constexpr double rounding = 1e-13;        // of the radius
constexpr double same_area = 1e-9;        // relative
constexpr std::size_t most_corners = 34;  // of two faces to be joined: bounds the work of every cut

class FaceFinder {
 public:
  explicit FaceFinder(const TriangleMesh& mesh)
      : mesh_(mesh), edges_(mesh.edges()), joined_(mesh.triangles.size()), loops_(mesh.triangles.size()) {}

  Faces run() {
    const std::vector<bool> flat = flat_patches();
    std::vector<std::size_t> left = inner_edges();
    std::erase_if(left, [&](std::size_t e) { return !flat[mesh_.triangle_patch[edges_[e].sides[0].triangle]]; });
    join_convex_patches(flat);
    // A union that is not convex now may be so once its neighbours have joined.
    while (std::erase_if(left, [&](std::size_t e) { return join_across(edges_[e]); })) continue;
    return collected();
  }

 private:
  std::vector<bool> flat_patches() const {
    std::vector<bool> flat(mesh_.patches.size(), true);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Patch& plane = mesh_.patch_of(t);
      for (const std::uint32_t v : mesh_.triangles[t])
        if (std::abs(plane.height(mesh_.vertices[v])) > rounding * mesh_.radius) flat[mesh_.triangle_patch[t]] = false;
    }
    return flat;
  }

  // A patch whose outline is one convex loop is one face, however it is cut into triangles: no joining by twos finds that where
  // vertices lie inside.
  void join_convex_patches(const std::vector<bool>& flat) {
    for (std::uint32_t patch = 0; patch < mesh_.patches.size(); ++patch) {
      const std::span<const std::uint32_t> members = mesh_.of_patch()[patch];
      if (!flat[patch] || members.size() < 3) continue;
      std::vector<std::uint32_t> outline = convex_outline(members, mesh_.patches[patch].normal);
      if (outline.empty()) continue;
      for (const std::uint32_t t : members) joined_.join(members[0], t);
      loops_[members[0]] = std::move(outline);
    }
  }

  // The corners of these triangles' outline; none if it is not one convex loop around all of their area.
  std::vector<std::uint32_t> convex_outline(std::span<const std::uint32_t> triangles, const dvec3& normal) const {
    const std::vector<std::uint32_t> loop = outline_loop(triangles);
    if (loop.size() < 3) return {};
    const std::vector<std::uint32_t> corners = true_corners(loop, normal);
    if (corners.size() < 3 || corners.size() > most_corners) return {};
    dvec3 inside(0.0), covered(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t before = corners[(i + corners.size() - 1) % corners.size()], after = corners[(i + 1) % corners.size()];
      if (turn(before, corners[i], after, normal) != Turn::left) return {};
      inside += area_vector(mesh_.vertices, {corners[0], corners[i], after});
    }
    for (const std::uint32_t t : triangles) covered += area_vector(mesh_.vertices, mesh_.triangles[t]);
    return glm::distance(inside, covered) <= same_area * glm::length(inside) ? corners : std::vector<std::uint32_t>();
  }

  // Sides of triangles across which the patch does not go on, one after the other; none if they are not one loop.
  std::vector<std::uint32_t> outline_loop(std::span<const std::uint32_t> triangles) const {
    std::map<std::uint32_t, std::uint32_t> next;
    for (const std::uint32_t t : triangles)
      for (int k = 0; k < 3; ++k)
        if (!goes_on(edges_[edges_.edge_of(t, k)]) &&
            !next.emplace(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]).second)
          return {};
    if (next.empty()) return {};
    std::vector<std::uint32_t> loop{next.begin()->first};
    for (auto at = next.find(next.begin()->second); at != next.end() && at->first != loop[0]; at = next.find(at->second)) {
      if (loop.size() == next.size()) return {};
      loop.push_back(at->first);
    }
    return loop.size() == next.size() ? loop : std::vector<std::uint32_t>();
  }

  double length(const EdgeTable::Edge& edge) const { return glm::distance(mesh_.vertices[edge.low], mesh_.vertices[edge.high]); }

  // Between two triangles of one patch that run along this edge in opposite senses.
  bool goes_on(const EdgeTable::Edge& edge) const { return mesh_.is_inside_patch(edge) && mesh_.is_surface(edge); }

  // Edges inside patches, longest first.
  std::vector<std::size_t> inner_edges() const {
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (goes_on(edges_[e])) found.emplace_back(-length(edges_[e]), e);
    std::ranges::sort(found);
    std::vector<std::size_t> order;
    for (const auto& entry : found) order.push_back(entry.second);
    return order;
  }

  bool join_across(const EdgeTable::Edge& edge) {
    const std::uint32_t a = joined_.root(edge.sides[0].triangle), b = joined_.root(edge.sides[1].triangle);
    if (a == b || loop(a).size() + loop(b).size() > most_corners) return false;
    const std::uint32_t start = mesh_.triangles[edge.sides[0].triangle][edge.sides[0].corner];
    std::vector<std::uint32_t> one = turned_to_end_at(loop(a), start),
                               other = turned_to_end_at(loop(b), edge.low + edge.high - start);
    drop_shared_chain(one, other);
    const dvec3& normal = mesh_.patch_of(edge.sides[0].triangle).normal;
    if (turn(one[one.size() - 2], one.back(), other[1], normal) == Turn::right) return false;
    if (turn(other[other.size() - 2], other.back(), one[1], normal) == Turn::right) return false;
    one.pop_back();
    one.insert(one.end(), other.begin(), other.end() - 1);
    loops_[std::min(a, b)] = std::move(one);
    loops_[std::max(a, b)] = {};
    joined_.join(std::min(a, b), std::max(a, b));
    return true;
  }

  std::span<const std::uint32_t> loop(std::uint32_t face) const {
    return loops_[face].empty() ? std::span<const std::uint32_t>(mesh_.triangles[face]) : loops_[face];
  }

  static std::vector<std::uint32_t> turned_to_end_at(std::span<const std::uint32_t> loop, std::uint32_t vertex) {
    std::vector<std::uint32_t> turned(loop.begin(), loop.end());
    std::rotate(turned.begin(), std::ranges::find(turned, vertex) + 1, turned.end());
    return turned;
  }

  // `one` runs from the end of the shared edge to its start, `other` from its start to its end. Where they go on side by side,
  // the shared edge is longer than one mesh edge.
  static void drop_shared_chain(std::vector<std::uint32_t>& one, std::vector<std::uint32_t>& other) {
    while (one.size() > 2 && other.size() > 2 && one[1] == other[other.size() - 2]) {
      one.erase(one.begin());
      other.pop_back();
    }
    while (one.size() > 2 && other.size() > 2 && other[1] == one[one.size() - 2]) {
      other.erase(other.begin());
      one.pop_back();
    }
  }

  enum class Turn { left, straight, right };

  Turn turn(std::uint32_t from, std::uint32_t at, std::uint32_t to, const dvec3& normal) const {
    const dvec3 in = mesh_.vertices[at] - mesh_.vertices[from], out = mesh_.vertices[to] - mesh_.vertices[at];
    const double sine = glm::dot(glm::cross(in, out), normal);
    const double uncertainty = rounding * mesh_.radius * std::min(glm::length(in), glm::length(out));
    if (std::abs(sine) > uncertainty) return sine > 0.0 ? Turn::left : Turn::right;
    return glm::dot(in, out) > 0.0 ? Turn::straight : Turn::right;
  }

  // The loop without the corners at which it runs straight on.
  std::vector<std::uint32_t> true_corners(const std::vector<std::uint32_t>& loop, const dvec3& normal) const {
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t before = loop[(i + loop.size() - 1) % loop.size()], after = loop[(i + 1) % loop.size()];
      if (turn(before, loop[i], after, normal) != Turn::straight) kept.push_back(loop[i]);
    }
    return kept;
  }

  Faces collected() {
    Faces result;
    result.face_of_triangle.resize(loops_.size());
    for (std::uint32_t t = 0; t < loops_.size(); ++t) {
      if (joined_.root(t) != t) continue;
      const std::uint32_t patch = mesh_.triangle_patch[t];
      std::span<const std::uint32_t> corners = loop(t);
      if (corners.size() > 3) corners = loops_[t] = true_corners(loops_[t], mesh_.patches[patch].normal);
      result.faces.push_back(
          {patch, t, static_cast<std::uint32_t>(result.corners.size()), static_cast<std::uint32_t>(corners.size())});
      result.corners.insert(result.corners.end(), corners.begin(), corners.end());
    }
    for (const Face& face : result.faces)
      result.face_of_triangle[face.triangle] = static_cast<std::uint32_t>(&face - &result.faces[0]);
    for (std::uint32_t t = 0; t < loops_.size(); ++t) result.face_of_triangle[t] = result.face_of_triangle[joined_.root(t)];
    return result;
  }

  const TriangleMesh& mesh_;
  const EdgeTable& edges_;
  DisjointSets joined_;                            // triangles of one face so far, by their lowest
  std::vector<std::vector<std::uint32_t>> loops_;  // corners of the face of that triangle, if it is not that triangle alone
};

}  // namespace

Faces find_faces(const TriangleMesh& mesh) { return FaceFinder(mesh).run(); }

}  // namespace raytube
