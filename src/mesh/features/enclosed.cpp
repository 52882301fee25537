#include "mesh/features/enclosed.h"

#include <algorithm>
#include <map>

#include "mesh/model/triangle_pairs.h"

namespace raytube {

namespace {

class EnclosedComponents {
 public:
  explicit EnclosedComponents(const FaceTree& tree)
      : tree_(tree),
        mesh_(tree.mesh()),
        boxes_(mesh_.components.size()),
        triangles_(triangle_rows(boxes_.size(), mesh_.triangle_component)) {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      for (const std::uint32_t v : mesh_.triangles[t]) boxes_[mesh_.triangle_component[t]].add(mesh_.vertices[v]);
  }

  std::vector<bool> run() {
    std::vector<bool> enclosed(boxes_.size());
    for (std::uint32_t c = 0; c < boxes_.size(); ++c) enclosed[c] = is_enclosed(c);
    return enclosed;
  }

 private:
  // A surface that does not cross the body's has one winding number, that of any of its points.
  bool is_enclosed(std::uint32_t component) {
    find_winding_numbers(component, mesh_.vertices[mesh_.triangles[triangles_[component][0]][0]]);
    return std::ranges::any_of(winding_numbers_, [&](const auto& body) {
      return body.second == 1 &&
             std::ranges::none_of(triangles_[component], [&](std::uint32_t t) { return may_touch(body.first, t); });
    });
  }

  // How often closed bodies whose boxes hold that of a component wind about a point: the faces that the line from there along z
  // leaves through, less those that it enters by. Each side is met by both of its triangles or by neither, whatever the rounding
  // (Shimrat 1962, Algorithm 112).
  void find_winding_numbers(std::uint32_t component, const dvec3& point) {
    winding_numbers_.clear();
    tree_.collect({point, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, dvec2(0.0), dvec2(0.0)}, found_);
    for (const std::uint32_t face : found_)
      for (const std::uint32_t t : tree_.triangles(face))
        if (const std::uint32_t body = mesh_.triangle_component[t]; may_hold(body, component) && is_above(t, point))
          winding_numbers_[body] += area_vector(mesh_.vertices, mesh_.triangles[t]).z > 0.0 ? 1 : -1;
  }

  bool may_hold(std::uint32_t body, std::uint32_t component) const {
    const Box &outer = boxes_[body], &inner = boxes_[component];
    return mesh_.components[body].closed && glm::all(glm::lessThan(outer.low, inner.low)) &&
           glm::all(glm::lessThan(inner.high, outer.high));
  }

  bool is_above(std::uint32_t triangle, const dvec3& point) const {
    const Triangle& corners = mesh_.triangles[triangle];
    bool over = false;
    for (int i = 0; i < 3; ++i)
      if (lies_beside(std::min(corners[i], corners[(i + 1) % 3]), std::max(corners[i], corners[(i + 1) % 3]), point))
        over = !over;
    const dvec3 across = area_vector(mesh_.vertices, corners);
    return over && glm::dot(across, mesh_.vertices[corners[0]] - point) * across.z > 0.0;
  }

  // Whether the line along x from a point meets the side between two vertices, all seen along z.
  bool lies_beside(std::uint32_t first, std::uint32_t last, const dvec3& point) const {
    const dvec3 &a = mesh_.vertices[first], &b = mesh_.vertices[last];
    return (a.y > point.y) != (b.y > point.y) && a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x) > point.x;
  }

  // Two triangles are apart if one lies clear of the other's plane; some others are, too.
  bool may_touch(std::uint32_t body, std::uint32_t triangle) {
    collect_near(tree_, mesh_.corners(triangle), margin_, found_);
    for (const std::uint32_t face : found_)
      for (const std::uint32_t other : tree_.triangles(face))
        if (mesh_.triangle_component[other] == body && !clear_of_plane(triangle, other) && !clear_of_plane(other, triangle))
          return true;
    return false;
  }

  bool clear_of_plane(std::uint32_t triangle, std::uint32_t plane) const {
    const std::uint32_t a = mesh_.triangles[plane][0];
    const dvec3 normal = glm::normalize(area_vector(mesh_.vertices, mesh_.triangles[plane]));
    const auto above = [&](std::uint32_t v) { return glm::dot(normal, mesh_.vertices[v] - mesh_.vertices[a]); };
    const auto [low, high] = std::ranges::minmax(mesh_.triangles[triangle], {}, above);
    return above(low) > margin_ || above(high) < -margin_;
  }

  const FaceTree& tree_;
  const TriangleMesh& mesh_;
  std::vector<Box> boxes_;  // of the components
  TriangleRows triangles_;  // of the components
  double margin_ = flat_fraction * 2.0 * mesh_.radius;
  std::vector<std::uint32_t> found_;
  std::map<std::uint32_t, int> winding_numbers_;  // by body
};

}  // namespace

std::vector<bool> find_enclosed_components(const FaceTree& tree) { return EnclosedComponents(tree).run(); }

std::uint64_t mark_enclosed(const TriangleMesh& mesh, const std::vector<bool>& components, std::vector<Wedge>& wedges) {
  std::vector<bool> patches(mesh.patches.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (components[mesh.triangle_component[t]]) patches[mesh.triangle_patch[t]] = true;
  std::uint64_t marked = 0;
  for (Wedge& wedge : wedges) {
    if (std::ranges::none_of(wedge.faces, [&](const WedgeFace& face) { return patches[face.patch]; })) continue;
    if (wedge.conducting() && !wedge.enclosed) ++marked;
    wedge.enclosed = true;
  }
  return marked;
}

}  // namespace raytube
