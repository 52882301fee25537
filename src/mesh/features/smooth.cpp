#include "mesh/features/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mesh/features/patch_borders.h"
#include "mesh/model/triangle_rows.h"

namespace raytube {

namespace {

// A patch this many times as wide as its neighbour across a crease is a panel: chords of one curve differ less.
constexpr double panel_ratio = 4.0;
// Flatter creases are the rounding of coordinates.
constexpr double least_crease = 1e-6;

dvec3 patch_normal(const TriangleMesh& mesh, std::uint32_t triangle) {
  return mesh.patches[mesh.triangle_patch[triangle]].normal;
}

std::size_t corner_of(const TriangleMesh& mesh, std::uint32_t triangle, std::uint32_t vertex) {
  const Triangle& t = mesh.triangles[triangle];
  return 3 * std::size_t{triangle} + static_cast<std::size_t>(std::ranges::find(t, vertex) - t.begin());
}

bool is_one_plane(const Patch& a, const Patch& b) { return a.normal == b.normal && a.offset == b.offset; }

// For each patch a number in common with those that it would be one patch with if all were made of the same.
std::vector<std::uint32_t> uncut_patches(const TriangleMesh& mesh, const EdgeTable& edges) {
  std::vector<std::uint32_t> parents(mesh.patches.size());
  std::iota(parents.begin(), parents.end(), 0u);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].sides.size() != 2) continue;
    const std::uint32_t a = mesh.triangle_patch[edges[e].sides[0].triangle], b = mesh.triangle_patch[edges[e].sides[1].triangle];
    if (mesh.patches[a].material == mesh.patches[b].material || !is_one_plane(mesh.patches[a], mesh.patches[b])) continue;
    parents[find_root(parents, b)] = find_root(parents, a);
  }
  return number_sets(std::move(parents));
}

// The creases of a tessellation, and which patches keep their planes.
class Tessellation {
 public:
  Tessellation(const TriangleMesh& mesh, double max_crease)
      : mesh_(mesh), edges_(mesh.triangles, mesh.vertices.size()), borders_(mesh, edges_), plane_(uncut_patches(mesh, edges_)) {
    patches_ = triangle_rows(mesh.patches.size(), plane_, [](std::uint32_t plane) { return std::array{plane}; });
    crossable_.resize(edges_.size());
    panel_.assign(mesh.patches.size(), true);
    for (std::size_t e = 0; e < edges_.size(); ++e) crossable_[e] = is_smooth(edges_[e], std::cos(max_crease));
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (crossable_[e] && is_crease(edges_[e])) set_curved(edges_[e]);
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (crossable_[e] && is_crease(edges_[e])) compare_widths(edges_[e]);
  }

  const EdgeTable& edges() const { return edges_; }
  bool crossable(std::size_t edge) const { return crossable_[edge]; }
  bool panel(std::uint32_t triangle) const { return panel_[plane(triangle)]; }
  void keep_flat(std::uint32_t triangle) { panel_[plane(triangle)] = true; }

  // Whether both sides of the edge are part of one curved surface of one material.
  bool joins(std::size_t edge) const {
    if (!crossable_[edge]) return false;
    const std::uint32_t a = edges_[edge].sides[0].triangle, b = edges_[edge].sides[1].triangle;
    return !panel(a) && !panel(b) && material(a) == material(b);
  }

 private:
  std::uint32_t plane(std::uint32_t triangle) const { return plane_[mesh_.triangle_patch[triangle]]; }
  std::uint32_t material(std::uint32_t triangle) const { return mesh_.patches[mesh_.triangle_patch[triangle]].material; }

  bool is_smooth(const EdgeTable::Edge& edge, double least_cosine) const {
    if (edge.sides.size() != 2) return false;
    const auto [a, b] = std::pair(edge.sides[0], edge.sides[1]);
    const bool opposite = mesh_.triangles[a.triangle][a.corner] != mesh_.triangles[b.triangle][b.corner];
    return opposite && glm::dot(patch_normal(mesh_, a.triangle), patch_normal(mesh_, b.triangle)) > least_cosine;
  }

  bool is_crease(const EdgeTable::Edge& edge) const {
    return glm::length(patch_normal(mesh_, edge.sides[0].triangle) - patch_normal(mesh_, edge.sides[1].triangle)) > least_crease;
  }

  void set_curved(const EdgeTable::Edge& edge) {
    for (const EdgeTable::Side& side : edge.sides) panel_[plane(side.triangle)] = false;
  }

  // Whether the patches of a plane reach further than `width` from an edge of it.
  bool reaches(std::uint32_t plane, const EdgeTable::Edge& edge, double width) const {
    const dvec3 start = mesh_.vertices[edge.low], along = glm::normalize(mesh_.vertices[edge.high] - start);
    const auto is_far = [&](std::uint32_t v) { return glm::length(glm::cross(mesh_.vertices[v] - start, along)) > width; };
    return std::ranges::any_of(patches_[plane],
                               [&](std::uint32_t patch) { return std::ranges::any_of(borders_[patch], is_far); });
  }

  double width(const EdgeTable::Edge& edge, const EdgeTable::Side& side) const {
    const double length = glm::length(mesh_.vertices[edge.high] - mesh_.vertices[edge.low]);
    return glm::length(area_vector(mesh_.vertices, mesh_.triangles[side.triangle])) / length;
  }

  void compare_widths(const EdgeTable::Edge& edge) {
    for (const int side : {0, 1}) {
      const std::uint32_t own = plane(edge.sides[side].triangle);
      if (!panel_[own] && reaches(own, edge, panel_ratio * width(edge, edge.sides[1 - side]))) panel_[own] = true;
    }
  }

  const TriangleMesh& mesh_;
  EdgeTable edges_;
  PatchBorders borders_;
  std::vector<std::uint32_t> plane_;  // of each patch: materials cut patches, but do not change what is a panel
  TriangleRows patches_;              // of each plane
  std::vector<bool> crossable_, panel_;
};

// Corners of triangles that share a vertex and hang together without a wedge share a normal: that of a panel among them, else the
// weighted mean that is exact for the vertices of a sphere (Max 1999, Weights for computing vertex normals from facet normals).
struct CornerNormals {
  CornerNormals(const TriangleMesh& mesh, const Tessellation& tessellation) {
    std::vector<std::uint32_t> parents(3 * mesh.triangles.size());
    for (std::uint32_t i = 0; i < parents.size(); ++i) parents[i] = i;
    for (std::size_t e = 0; e < tessellation.edges().size(); ++e) {
      if (!tessellation.crossable(e)) continue;
      const auto [low, high, sides] = tessellation.edges()[e];
      for (const std::uint32_t v : {low, high}) {
        const auto a = static_cast<std::uint32_t>(corner_of(mesh, sides[0].triangle, v));
        const auto b = static_cast<std::uint32_t>(corner_of(mesh, sides[1].triangle, v));
        parents[find_root(parents, b)] = find_root(parents, a);
      }
    }
    index = number_sets(std::move(parents));
    add_up(mesh, tessellation);
  }

  std::vector<std::uint32_t> index;  // in `normals`, for each corner of each triangle
  std::vector<dvec3> normals;

 private:
  void add_up(const TriangleMesh& mesh, const Tessellation& tessellation) {
    const std::size_t count = index.empty() ? 0 : *std::ranges::max_element(index) + 1;
    normals.assign(count, dvec3(0.0));
    std::vector<dvec3> panels(count, dvec3(0.0));
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      for (int c = 0; c < 3; ++c) {
        const auto vertex = [&](int i) { return mesh.vertices[mesh.triangles[t][(c + i) % 3]]; };
        const dvec3 a = vertex(1) - vertex(0), b = vertex(2) - vertex(0);
        const dvec3 weighted = glm::cross(a, b) / (glm::dot(a, a) * glm::dot(b, b));
        (tessellation.panel(t) ? panels : normals)[index[3 * std::size_t{t} + c]] += weighted;
      }
    }
    for (std::size_t i = 0; i < count; ++i) normals[i] = glm::normalize(panels[i] == dvec3(0.0) ? normals[i] : panels[i]);
  }
};

// The parabola over a side whose ends have these normals, along their mean: r = a + x (b - a) - x (1 - x) bend.
dvec3 bend_of(const dvec3& side, const dvec3& normal_a, const dvec3& normal_b) {
  const dvec3 sum = normal_a + normal_b;
  return sum * (glm::dot(normal_a - normal_b, side) / glm::dot(sum, sum));
}

}  // namespace

SmoothSurfaces::SmoothSurfaces(const TriangleMesh& mesh, double max_crease, double max_rise) : mesh_(mesh) {
  Tessellation tessellation(mesh, max_crease);
  const auto set_normals = [&] {
    CornerNormals corners(mesh, tessellation);
    corner_normal_ = std::move(corners.index);
    normals_ = std::move(corners.normals);
  };
  set_normals();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      if (!tessellation.panel(t) && glm::length(bend(t, c)) > 4.0 * max_rise) tessellation.keep_flat(t);
  set_normals();
  const EdgeTable& edges = tessellation.edges();
  region_.assign(mesh.triangles.size(), no_index);
  boundary_.assign(3 * mesh.triangles.size(), true);
  std::vector<std::uint32_t> parents(mesh.triangles.size());
  for (std::uint32_t i = 0; i < parents.size(); ++i) parents[i] = i;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (!tessellation.joins(e)) continue;
    const auto sides = edges[e].sides;
    for (const EdgeTable::Side& side : sides) boundary_[3 * std::size_t{side.triangle} + side.corner] = false;
    parents[find_root(parents, sides[1].triangle)] = find_root(parents, sides[0].triangle);
  }
  const std::vector<std::uint32_t> groups = number_sets(std::move(parents));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (tessellation.panel(t)) continue;
    region_[t] = groups[t];
    ++facets_;
    for (int c = 0; c < 3; ++c) rise_ = std::max(rise_, 0.25 * glm::length(bend(t, c)));
  }
}

std::size_t SmoothSurfaces::conducting_facets() const {
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < region_.size(); ++t) count += conducts(t);
  return count;
}

double SmoothSurfaces::boundary_length() const {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c)
      if (region_[t] != no_index && on_boundary(t, c))
        sum += glm::distance(mesh_.vertices[mesh_.triangles[t][c]], mesh_.vertices[mesh_.triangles[t][(c + 1) % 3]]);
  return sum;
}

dvec3 SmoothSurfaces::bend(std::uint32_t triangle, int corner) const {
  const Triangle& t = mesh_.triangles[triangle];
  const int next = (corner + 1) % 3;
  const auto normal = [&](int c) { return normals_[corner_normal_[3 * std::size_t{triangle} + c]]; };
  return bend_of(mesh_.vertices[t[next]] - mesh_.vertices[t[corner]], normal(corner), normal(next));
}

namespace {

// Where the line meets it: Newton's method across the line, from the facet's plane. Nothing if that does not settle near it.
std::optional<dvec2> meet(const BentFacet& s, const dvec3& origin, const dvec3& direction) {
  dvec2 l(1.0 / 3.0);
  const double size = glm::distance(s.corners()[1], s.corners()[0]) + glm::distance(s.corners()[2], s.corners()[0]);
  for (int step = 0; step < 12; ++step) {
    // Solves off + dl1 a + dl2 b = (anything) direction.
    const dvec3 off = s.point(l) - origin, a = s.along_1(l), b = s.along_2(l);
    const double determinant = glm::dot(glm::cross(a, b), direction);
    if (std::abs(determinant) < 1e-12 * size * size) return {};
    const dvec2 change = -dvec2(glm::dot(glm::cross(off, b), direction), glm::dot(glm::cross(a, off), direction)) / determinant;
    l += change;
    if (std::max(std::abs(l.x - 1.0 / 3.0), std::abs(l.y - 1.0 / 3.0)) > 4.0) return {};
    if (std::max(std::abs(change.x), std::abs(change.y)) < 1e-10) return l;
  }
  return {};
}

LocalSurface facet_plane(const Patch& patch, const dvec3& origin, const dvec3& direction) {
  const double facing = glm::dot(patch.normal, direction);
  const double distance = (patch.offset - glm::dot(patch.normal, origin)) / facing;
  return {origin + distance * direction, facing < 0.0 ? patch.normal : -patch.normal, glm::dmat3(0.0)};
}

// Second fundamental form of a parametrised surface with tangents a1, a2 and second derivatives r11, r12, r22 (do Carmo 1976,
// section 3-3), as a matrix of space, with the stronger principal curvature along the normal.
glm::dmat3 curvature_of(const dvec3& a1, const dvec3& a2, const dvec3& n, const dvec3& r11, const dvec3& r12, const dvec3& r22) {
  const dvec3 dual1 = glm::cross(a2, n) / glm::dot(a1, glm::cross(a2, n)),
              dual2 = glm::cross(n, a1) / glm::dot(a2, glm::cross(n, a1));
  const double l = glm::dot(n, r11), m = glm::dot(n, r12), r = glm::dot(n, r22);
  const dvec3 area = glm::cross(a1, a2);
  const double sum = l * glm::dot(dual1, dual1) + 2.0 * m * glm::dot(dual1, dual2) + r * glm::dot(dual2, dual2);
  const double product = (l * r - m * m) / glm::dot(area, area);
  const double stronger = 0.5 * sum + std::copysign(std::sqrt(std::max(0.0, 0.25 * sum * sum - product)), sum);
  return l * glm::outerProduct(dual1, dual1) + m * (glm::outerProduct(dual1, dual2) + glm::outerProduct(dual2, dual1)) +
         r * glm::outerProduct(dual2, dual2) + stronger * glm::outerProduct(n, n);
}

}  // namespace

SurfacePoint BentFacet::over(const dvec3& r) const {
  const dvec3 e1 = x_[1] - x_[0], e2 = x_[2] - x_[0], across = glm::cross(e1, e2), step = r - x_[0];
  const double square = glm::dot(across, across);
  const dvec2 l{glm::dot(glm::cross(step, e2), across) / square, glm::dot(glm::cross(e1, step), across) / square};
  const dvec3 normal = glm::cross(along_1(l), along_2(l));
  const double size = glm::length(normal);
  return {point(l), normal / size, size / std::sqrt(square)};
}

BentFacet SmoothSurfaces::facet(std::uint32_t triangle) const {
  const Triangle& t = mesh_.triangles[triangle];
  return {{mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]},
          {bend(triangle, 0), bend(triangle, 1), bend(triangle, 2)}};
}

LocalSurface SmoothSurfaces::at(const dvec3& origin, const dvec3& direction, std::uint32_t triangle) const {
  const Patch& patch = mesh_.patches[mesh_.triangle_patch[triangle]];
  const BentFacet s = facet(triangle);
  const std::optional<dvec2> l = meet(s, origin, direction);
  if (!l) return facet_plane(patch, origin, direction);
  const dvec3 a1 = s.along_1(*l), a2 = s.along_2(*l);
  dvec3 n = glm::normalize(glm::cross(a1, a2));
  const bool from_front = glm::dot(patch.normal, direction) < 0.0;
  if ((glm::dot(n, direction) < 0.0) != from_front) return facet_plane(patch, origin, direction);
  if (!from_front) n = -n;
  const dvec3 point = origin + glm::dot(s.point(*l) - origin, direction) * direction;
  return {point, n, curvature_of(a1, a2, n, 2.0 * s.bend(0), s.bend(0) - s.bend(1) + s.bend(2), 2.0 * s.bend(2))};
}

}  // namespace raytube
