#include "mesh/features/symmetry.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mesh/model/point_tree.h"

namespace raytube {

namespace {

constexpr double same_angle = 1e-9;  // of planes and wedges that outlines have made images of one another

// Coordinates were moved by the centre, whose own rounding counts as well.
double symmetry_rounding(const TriangleMesh& mesh) {
  return 16.0 * std::numeric_limits<double>::epsilon() * (mesh.radius + glm::length(mesh.center));
}

dvec3 image(dvec3 at, int axis) {
  at[axis] = -at[axis];
  return at;
}

void find_near(const PointTree& tree, const dvec3& at, double distance, std::vector<std::uint32_t>& found) {
  const dvec3 hair{distance, 0.0, 0.0};  // a segment has a length
  tree.near_segment(at - hair, at + hair, distance, found);
}

// Where patches end: edges at which anything but two triangles of one patch meet. Or, with `facets`, all edges.
struct Outline {
  std::vector<std::size_t> ends{};       // among the edges of the mesh
  std::vector<std::uint32_t> corners{};  // their vertices
};

Outline outline_of(const TriangleMesh& mesh, bool facets) {
  const EdgeTable& edges = mesh.edges();
  Outline outline;
  std::vector<bool> used(mesh.vertices.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!facets && mesh.is_inside_patch(edges[e])) continue;
    outline.ends.push_back(e);
    used[edges[e].low] = used[edges[e].high] = true;
  }
  for (std::uint32_t v = 0; v < used.size(); ++v)
    if (used[v]) outline.corners.push_back(v);
  return outline;
}

// The target against its image across one plane. If every outline edge has an image, with the images of its patches, and patches
// are one another's images in pairs, then every patch has the image of its plane and of all its borders.
class PatchSymmetry {
 public:
  PatchSymmetry(const TriangleMesh& mesh, const Outline& outline, const PointTree& corners, int axis)
      : outline_(outline),
        mesh_(mesh),
        edges_(mesh.edges()),
        tree_(corners),
        axis_(axis),
        rounding_(symmetry_rounding(mesh_)),
        image_of_vertex_(mesh_.vertices.size(), no_index),
        image_of_patch_(mesh_.patches.size(), no_index) {}

  bool is_symmetry() {
    return std::ranges::all_of(outline_.corners, [&](std::uint32_t v) { return find_image(v); }) &&
           std::ranges::all_of(outline_.ends, [&](std::size_t e) { return has_image(edges_[e]); }) &&
           std::ranges::all_of(image_of_patch_, [&](std::uint32_t& q) { return image_of_patch_[q] == &q - &image_of_patch_[0]; });
  }

 private:
  bool find_image(std::uint32_t vertex) {
    found_.clear();
    find_near(tree_, image(mesh_.vertices[vertex], axis_), rounding_, found_);
    if (found_.size() != 1) return false;
    image_of_vertex_[vertex] = found_[0];
    return true;
  }

  bool has_image(const EdgeTable::Edge& edge) {
    const auto [low, high] = std::minmax(image_of_vertex_[edge.low], image_of_vertex_[edge.high]);
    const std::size_t found = edges_.find(low, high);
    if (found == edges_.size()) return false;
    const auto others = edges_[found].sides;
    return others.size() == edge.sides.size() && std::ranges::all_of(edge.sides, [&](const EdgeTable::Side& side) {
             return std::ranges::any_of(others, [&](const auto& other) { return is_image(side, other, edge); });
           });
  }

  bool is_image(const EdgeTable::Side& side, const EdgeTable::Side& other, const EdgeTable::Edge& edge) {
    const std::uint32_t p = mesh_.triangle_patch[side.triangle], q = mesh_.triangle_patch[other.triangle];
    if (image_of_patch_[p] != no_index) return image_of_patch_[p] == q;
    const bool closed = mesh_.closed(side.triangle);
    if (closed != mesh_.closed(other.triangle) || !is_image(mesh_.patches[p], mesh_.patches[q], closed, edge)) return false;
    image_of_patch_[p] = q;
    return true;
  }

  // An open surface that conducts has two sides alike, so its normal may point either way. Of sheets the layers count from it.
  bool is_image(const Patch& plane, const Patch& other, bool closed, const EdgeTable::Edge& edge) const {
    const double along = glm::dot(image(plane.normal, axis_), other.normal), sign = along > 0.0 ? 1.0 : -1.0;
    const bool sided = closed || plane.material != no_index;
    if (plane.material != other.material || std::abs(along) < 1.0 - same_angle || (sided && sign < 0.0)) return false;
    return std::ranges::all_of(std::array{edge.low, edge.high}, [&](std::uint32_t v) {
      return std::abs(plane.height(mesh_.vertices[v]) - sign * other.height(mesh_.vertices[image_of_vertex_[v]])) <= rounding_;
    });
  }

  const Outline& outline_;
  const TriangleMesh& mesh_;
  const EdgeTable& edges_;
  const PointTree& tree_;
  int axis_;
  double rounding_;
  std::vector<std::uint32_t> image_of_vertex_, image_of_patch_, found_;
};

bool is_image(const Wedge& wedge, const Wedge& other, int axis, double rounding) {
  const dvec3 start = image(wedge.start, axis);
  const double apart = std::min(glm::distance(start, other.start), glm::distance(start, other.end));
  return apart <= rounding && std::abs(wedge.n - other.n) <= same_angle;
}

}  // namespace

std::array<bool, 3> find_symmetry_planes(const TriangleMesh& mesh, std::span<const Wedge> wedges, bool facets) {
  const Outline outline = outline_of(mesh, facets);
  const PointTree corners(mesh.vertices, outline.corners);
  std::vector<dvec3> middles;  // by which wedges are found
  for (const Wedge& wedge : wedges) middles.push_back(0.5 * (wedge.start + wedge.end));
  std::vector<std::uint32_t> all(wedges.size()), found;
  std::iota(all.begin(), all.end(), 0u);
  const PointTree by_middle(middles, std::move(all));
  const double rounding = symmetry_rounding(mesh);
  const auto has_image = [&](const Wedge& wedge, int axis) {
    found.clear();
    find_near(by_middle, image(0.5 * (wedge.start + wedge.end), axis), rounding, found);
    return std::ranges::any_of(found, [&](std::uint32_t other) { return is_image(wedge, wedges[other], axis, rounding); });
  };
  std::array<bool, 3> planes;
  for (int axis = 0; axis < 3; ++axis)
    planes[axis] = PatchSymmetry(mesh, outline, corners, axis).is_symmetry() &&
                   std::ranges::all_of(wedges, [&](const Wedge& wedge) { return has_image(wedge, axis); });
  return planes;
}

}  // namespace raytube
