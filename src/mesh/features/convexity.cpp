#include "mesh/features/convexity.h"

#include <algorithm>
#include <limits>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

// Bounds the time that corners shared by very many facets could take.
constexpr std::uint64_t most_comparisons = 100'000'000;
constexpr double most_reach = 100.0;  // of slivers

// What rises less above a plane is not met by a ray that leaves it (ExactHit::ahead), or is no more than files leave of plane
// faces (find_patches).
double rounding(const TriangleMesh& mesh) {
  return 8.0 * std::numeric_limits<double>::epsilon() * mesh.radius + rounding_steps * mesh.coordinate_step;
}

bool lies_in_one_plane(const TriangleMesh& mesh) {
  return std::ranges::all_of(mesh.vertices,
                             [&](const dvec3& v) { return std::abs(mesh.patches[0].height(v)) <= rounding(mesh); });
}

// A closed connected surface is the boundary of a convex body if it is convex about each of its points (van Heijenoort 1952);
// about those inside facets it always is, about those inside edges if it is so about their ends.
class ConvexBody {
 public:
  explicit ConvexBody(const TriangleMesh& mesh) : mesh_(mesh), rounding_(rounding(mesh)) {}

  bool found() {
    if (mesh_.components.size() != 1 || !mesh_.components[0].closed) return false;
    const EdgeTable& edges = mesh_.edges();
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges[e].sides.size() != 2) return false;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v)
      if (!neighbours_lie_behind(v) || !winds_once(v)) return false;
    return true;
  }

 private:
  std::span<const std::uint32_t> around(std::uint32_t v) const { return mesh_.at_vertex()[v]; }

  // The planes that meet at a vertex hold it, and have none of its neighbours in front.
  bool neighbours_lie_behind(std::uint32_t v) {
    planes_.clear();
    for (const std::uint32_t t : around(v)) planes_.push_back(mesh_.triangle_patch[t]);
    std::ranges::sort(planes_);
    planes_.erase(std::unique(planes_.begin(), planes_.end()), planes_.end());
    comparisons_ += 3 * planes_.size() * around(v).size();
    return comparisons_ <= most_comparisons && std::ranges::all_of(planes_, [&](std::uint32_t p) {
             const Patch& plane = mesh_.patches[p];
             if (std::abs(plane.height(mesh_.vertices[v])) > rounding_) return false;
             const double allowed = rounding_ + (mesh_.coordinate_step > 0.0 ? rise_by_rounding(v, p) : 0.0);
             return std::ranges::all_of(around(v), [&](std::uint32_t t) {
               const auto [a, b, c] = mesh_.corners(t);
               return std::max({plane.height(a), plane.height(b), plane.height(c)}) <= allowed;
             });
           });
  }

  // By how much the rounding of its corners may turn a plane at a vertex, seen from the farthest corner there: as much as the
  // highest of its facets there is lower than that is far.
  double rise_by_rounding(std::uint32_t v, std::uint32_t plane) const {
    double farthest = 0.0, highest = 0.0;
    for (const std::uint32_t t : around(v)) {
      for (const std::uint32_t w : mesh_.triangles[t])
        farthest = std::max(farthest, glm::distance(mesh_.vertices[v], mesh_.vertices[w]));
      if (mesh_.triangle_patch[t] == plane) highest = std::max(highest, height(mesh_.vertices, mesh_.triangles[t]));
    }
    return mesh_.coordinate_step * std::min(most_reach, farthest / highest);
  }

  // Seen from outside, the facets at a vertex go round it once: neither do they overlap nor do two tips touch there.
  bool winds_once(std::uint32_t v) const {
    dvec3 axis(0.0);
    for (const std::uint32_t t : around(v)) axis += mesh_.patch_of(t).normal;
    double angle = 0.0;
    for (const std::uint32_t t : around(v)) {
      const auto& triangle = mesh_.triangles[t];
      const std::uint32_t corner = corner_at(triangle, v);
      const dvec3 a = mesh_.vertices[triangle[(corner + 1) % 3]] - mesh_.vertices[v],
                  b = mesh_.vertices[triangle[(corner + 2) % 3]] - mesh_.vertices[v];
      // In the plane across the axis.
      angle += std::atan2(glm::length(axis) * glm::dot(axis, glm::cross(a, b)),
                          glm::dot(axis, axis) * glm::dot(a, b) - glm::dot(axis, a) * glm::dot(axis, b));
    }
    return std::abs(angle / (2.0 * pi) - 1.0) < 0.1;  // else it is another whole number
  }

  const TriangleMesh& mesh_;
  double rounding_;
  std::vector<std::uint32_t> planes_;
  std::uint64_t comparisons_ = 0;
};

}  // namespace

Convexity find_convexity(const TriangleMesh& mesh) {
  if (ConvexBody(mesh).found()) return {true, true};
  return {lies_in_one_plane(mesh), false};
}

namespace {

/// The vertices next to each vertex.
std::vector<std::vector<std::uint32_t>> neighbours_of(const TriangleMesh& mesh) {
  std::vector<std::vector<std::uint32_t>> next(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles)
    for (int c = 0; c < 3; ++c) next[t[c]].push_back(t[(c + 1) % 3]);
  return next;
}

std::vector<dvec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<dvec3> normals(mesh.vertices.size(), dvec3(0.0));
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) normals[v] += area_vector(mesh.vertices, t);
  return normals;
}

}  // namespace

bool convex_up_to(const TriangleMesh& mesh, double dent) {
  if (mesh.components.size() != 1 || !mesh.components[0].closed) return false;
  const auto next = neighbours_of(mesh);
  const std::vector<dvec3> normals = vertex_normals(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (next[v].empty() || normals[v] == dvec3(0.0)) continue;
    const dvec3 up = glm::normalize(normals[v]);
    const auto height = [&](std::uint32_t w) { return glm::dot(up, mesh.vertices[w]); };
    std::uint32_t top = v;
    for (bool climbs = true; climbs;) {
      const std::uint32_t best = *std::ranges::max_element(next[top], {}, height);
      climbs = height(best) > height(top);
      if (climbs) top = best;
    }
    if (height(top) - height(v) > dent) return false;
  }
  return true;
}

}  // namespace raytube
