#include "mesh/smooth/corner_normals.h"

#include <algorithm>
#include <array>

#include "mesh/model/triangle_rows.h"

namespace raytube {

namespace {

// A facet this many times as wide as what lies across a crease is a panel: chords of one curve differ less.
constexpr double panel_ratio = 4.0;
// And the surface begins to bend at the crease: the facets across lean off the panel's plane by at most so many times what they
// turn by at their far ends, where a chord of one curve would lean by panel_ratio + 1 times as much; and without the panel they
// turn by this share of it at most at the crease, where one curve would turn by as much.
constexpr double most_lean = 3.0, most_turn = 0.5;
// A facet so many times as narrow as another one at a vertex is a sliver: how it lies is rounding, and its surface is the
// other's.
constexpr double sliver_ratio = 25.0;

// Cosine of the angle by which a facet may lie off the plane of its patch.
constexpr double least_agreement = 0.999;

// Turns below this share of a lean are rounding.
constexpr double least_turn = 1e-6;

class Finder {
 public:
  Finder(const TriangleMesh& mesh, const Creases& creases, CornerNormals& found)
      : mesh_(mesh), creases_(creases), found_(found) {}

  void find() {
    group_corners();
    find_slivers();
    leads_.assign(found_.group.size(), false);
    is_led_.assign(groups_, false);
    found_.normals.resize(groups_);
    for (std::uint32_t group = 0; group < groups_; ++group) add_up(group);
    find_leaders();
    for (std::uint32_t group = 0; group < groups_; ++group)
      if (is_led_[group]) add_up(group);
    find_one_sided();
    find_planes();
  }

 private:
  std::uint32_t plane_of_corner(std::uint32_t corner) const { return creases_.plane(corner / 3); }
  std::uint32_t vertex_of_corner(std::uint32_t corner) const { return mesh_.triangles[corner / 3][corner % 3]; }

  std::uint32_t corner_of(std::uint32_t triangle, std::uint32_t vertex) const {
    return 3 * triangle + corner_at(mesh_.triangles[triangle], vertex);
  }

  void group_corners() {
    DisjointSets groups(3 * mesh_.triangles.size());
    const EdgeTable& edges = creases_.edges();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (!creases_.crossable(e)) continue;
      for (const std::uint32_t v : {edges[e].low, edges[e].high}) {
        const std::uint32_t a = corner_of(edges[e].sides[0].triangle, v), b = corner_of(edges[e].sides[1].triangle, v);
        groups.join(a, b);
      }
    }
    found_.group = groups.numbers();
    groups_ = found_.group.empty() ? 0 : *std::ranges::max_element(found_.group) + 1;
    corners_ = triangle_rows(groups_, found_.group);
  }

  void find_slivers() {
    const std::vector<double> widths = plane_widths();
    is_sliver_.assign(found_.group.size(), false);
    for (std::uint32_t group = 0; group < groups_; ++group) {
      double widest = 0.0;
      for (const std::uint32_t corner : corners_[group]) widest = std::max(widest, widths[plane_of_corner(corner)]);
      for (const std::uint32_t corner : corners_[group])
        is_sliver_[corner] = sliver_ratio * widths[plane_of_corner(corner)] < widest;
    }
  }

  // Area over length.
  std::vector<double> plane_widths() const {
    std::vector<double> areas(creases_.planes(), 0.0);
    std::vector<Box> boxes(creases_.planes());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      areas[creases_.plane(t)] += mesh_.twice_area(t);
      for (const std::uint32_t v : mesh_.triangles[t]) boxes[creases_.plane(t)].add(mesh_.vertices[v]);
    }
    for (std::size_t p = 0; p < areas.size(); ++p) areas[p] /= boxes[p].diagonal();
    return areas;
  }

  void find_leaders() {
    const EdgeTable& edges = creases_.edges();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      if (!creases_.crossable(e) || !creases_.is_crease(edges[e])) continue;
      for (const std::size_t side : {0u, 1u})
        if (is_panel(edges[e], edges[e].sides[side], edges[e].sides[1 - side])) lead(edges[e], edges[e].sides[side]);
    }
  }

  bool is_panel(const EdgeTable::Edge& edge, const EdgeTable::Side& own, const EdgeTable::Side& other) const {
    const std::uint32_t plane = creases_.plane(own.triangle);
    if (!creases_.reaches(plane, edge, panel_ratio * creases_.width(edge, other))) return false;
    const Across across = look_across(edge, own, other);
    // A bevel that ends in an edge or a plane does not turn at all.
    if (across.turn_there <= least_turn * across.lean) return true;
    return across.lean < most_lean * across.turn_there && across.turn_here < most_turn * across.turn_there &&
           creases_.reaches(plane, edge, panel_ratio * across.reach);
  }

  void lead(const EdgeTable::Edge& edge, const EdgeTable::Side& own) {
    for (const std::uint32_t v : {edge.low, edge.high}) {
      const std::uint32_t group = found_.group[corner_of(own.triangle, v)];
      is_led_[group] = true;
      for (const std::uint32_t corner : corners_[group])
        if (plane_of_corner(corner) == creases_.plane(own.triangle)) leads_[corner] = true;
    }
  }

  // What the facets at the ends of an edge are like on the side of `other`: how far they reach, how much they lean off the plane
  // of `own`, and off the normals at both ends of their sides, that plane left out; across the edge alone, and summed.
  struct Across {
    double reach = 0.0, lean = 0.0, turn_here = 0.0, turn_there = 0.0;
  };

  Across look_across(const EdgeTable::Edge& edge, const EdgeTable::Side& own, const EdgeTable::Side& other) const {
    const dvec3& plane = mesh_.patch_of(own.triangle).normal;
    const dvec3 start = mesh_.vertices[edge.low], along = glm::normalize(mesh_.vertices[edge.high] - start);
    const dvec3 to_tip = mesh_.vertices[mesh_.triangles[other.triangle][(other.corner + 2) % 3]] - start;
    const dvec3 direction = to_tip - glm::dot(to_tip, along) * along;
    const double length = glm::distance(mesh_.vertices[edge.high], start), height = glm::length(direction);
    const auto lies_over = [&](std::uint32_t w) {
      const double x = glm::dot(mesh_.vertices[w] - start, along), y = glm::dot(mesh_.vertices[w] - start, direction) / height;
      return std::abs(x - 0.5 * length) < length && y > 0.2 * height;
    };
    Across across;
    for (const std::uint32_t v : {edge.low, edge.high}) {
      const std::uint32_t group = found_.group[corner_of(other.triangle, v)];
      const dvec3 normal = normal_without(group, creases_.plane(own.triangle));
      for (const std::uint32_t corner : corners_[group])
        for (const std::uint32_t far : {corner - corner % 3 + (corner + 1) % 3, corner - corner % 3 + (corner + 2) % 3}) {
          const dvec3 way = mesh_.vertices[vertex_of_corner(far)] - mesh_.vertices[v];
          const double reach = glm::dot(way, direction);
          if (reach <= 0.0) continue;
          const dvec3 step = way - glm::dot(way, along) * along;
          const auto lean = [&](const dvec3& n) { return std::abs(glm::dot(n, step)) / glm::length(step); };
          across.reach = std::max(across.reach, reach / height);
          if (!lies_over(vertex_of_corner(far))) continue;
          across.lean += lean(plane);
          across.turn_here += lean(normal);
          across.turn_there += lean(found_.normals[found_.group[far]]);
        }
    }
    return across;
  }

  dvec3 normal_without(std::uint32_t group, std::uint32_t plane) const {
    dvec3 sum(0.0);
    for (const std::uint32_t corner : corners_[group])
      if (plane_of_corner(corner) != plane && !is_sliver_[corner]) sum += weighted_normal(corner);
    return sum == dvec3(0.0) ? sum : glm::normalize(sum);
  }

  // Needles within a plane may be turned off it or folded over: they have its normal.
  dvec3 weighted_normal(std::uint32_t corner) const {
    const Triangle& t = mesh_.triangles[corner / 3];
    const auto side_to = [&](std::uint32_t i) { return mesh_.vertices[t[(corner + i) % 3]] - mesh_.vertices[t[corner % 3]]; };
    const dvec3 a = side_to(1), b = side_to(2), area = glm::cross(a, b);
    const dvec3& plane = mesh_.patch_of(corner / 3).normal;
    const double size = glm::length(area);
    return (glm::dot(area, plane) > least_agreement * size ? area : size * plane) / (glm::dot(a, a) * glm::dot(b, b));
  }

  bool gives_normal(std::uint32_t corner) const { return is_led_[found_.group[corner]] ? leads_[corner] : !is_sliver_[corner]; }

  void add_up(std::uint32_t group) {
    dvec3 sum(0.0);
    for (const std::uint32_t corner : corners_[group])
      if (gives_normal(corner)) sum += weighted_normal(corner);
    found_.normals[group] = glm::normalize(sum);
  }

  void find_one_sided() {
    found_.one_sided.assign(groups_, false);
    for (std::uint32_t corner = 0; corner < found_.group.size(); ++corner)
      for (const std::uint32_t side : {corner % 3, (corner + 2) % 3})
        if (!is_led_[found_.group[corner]] && !creases_.crossable(creases_.edges().edge_of(corner / 3, static_cast<int>(side))))
          found_.one_sided[found_.group[corner]] = true;
  }

  void find_planes() {
    found_.is_plane.assign(creases_.planes(), true);
    for (std::uint32_t group = 0; group < groups_; ++group) {
      std::uint32_t only = no_index;
      bool mixed = false;
      for (const std::uint32_t corner : corners_[group]) {
        if (!gives_normal(corner)) continue;
        mixed = mixed || (only != no_index && only != plane_of_corner(corner));
        only = plane_of_corner(corner);
      }
      for (const std::uint32_t corner : corners_[group])
        if (mixed || plane_of_corner(corner) != only) found_.is_plane[plane_of_corner(corner)] = false;
    }
  }

  const TriangleMesh& mesh_;
  const Creases& creases_;
  CornerNormals& found_;
  std::uint32_t groups_ = 0;
  TriangleRows corners_;         // of each group
  std::vector<bool> is_sliver_;  // [corner]
  std::vector<bool> leads_;      // [corner] its normal counts where there are others of narrow facets
  std::vector<bool> is_led_;     // [group]
};

}  // namespace

CornerNormals::CornerNormals(const TriangleMesh& mesh, const Creases& creases) { Finder(mesh, creases, *this).find(); }

}  // namespace raytube
