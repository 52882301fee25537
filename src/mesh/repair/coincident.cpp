#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "mesh/repair/edge_splits.h"
#include "mesh/repair/steps.h"

namespace raytube {

namespace {

constexpr double flat_per_weld = flat_fraction / weld_fraction;
constexpr double most_warp = pi / 12.0;  // of a polygon: the crease that is tessellation by default [rad]
constexpr int most_align_rounds = 8;     // two do; the cap is there because nothing proves it

using Ends = std::pair<std::uint32_t, std::uint32_t>;  // the lower vertex first
using Chains = std::vector<EdgeSplit>;                 // straight sides of an outline, each with the vertices on it

/// The triangles of a mesh in groups that are joined over edges of exactly two triangles, and the outlines of these groups.
class FaceGroups {
 public:
  template <class Crossable>
  FaceGroups(std::span<const dvec3> vertices, const Facets& facets, double distance, Crossable crossable)
      : vertices_(vertices), facets_(facets), distance_(distance), edges_(facets.triangles, vertices.size()) {
    group_ = connected_groups(edges_, facets.triangles.size(), [&](const EdgeTable::Edge& edge) {
      return edge.sides.size() == 2 && alike(edge.sides[0].triangle, edge.sides[1].triangle) &&
             crossable(edge, apex(edge.sides[0]), apex(edge.sides[1]));
    });
    members_ = triangle_rows(group_.empty() ? 0 : *std::ranges::max_element(group_) + 1, group_);
    std::vector<std::uint32_t> beside;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      beside.clear();
      for (const EdgeTable::Side& side : edges_[e].sides) beside.push_back(group_[side.triangle]);
      for (const std::uint32_t group : beside)
        if (std::ranges::count(beside, group) == 1) outlines_.emplace_back(group, Ends(edges_[e].low, edges_[e].high));
    }
    std::ranges::sort(outlines_);
  }

  std::uint32_t size() const { return members_.size(); }
  std::uint32_t group_of(std::uint32_t triangle) const { return group_[triangle]; }
  std::span<const std::uint32_t> triangles(std::uint32_t group) const { return members_[group]; }
  auto outline(std::uint32_t group) const { return entries_of(outlines_, group); }

  /// The outline without the vertices on its straight sides, in an order of its own.
  Chains chains(std::uint32_t group) const {
    std::vector<Ends> steps;  // both ways
    for (const auto& [number, ends] : outline(group)) {
      steps.push_back(ends);
      steps.emplace_back(ends.second, ends.first);
    }
    std::ranges::sort(steps);
    Chains result;
    for (const auto& [from, to] : steps)
      if (is_corner(steps, from)) add_chain(steps, from, to, result);
    if (result.size() < 3) {  // round: each of its vertices counts
      result.clear();
      for (const auto& [number, ends] : outline(group)) result.push_back({ends.first, ends.second, {}});
    }
    std::ranges::sort(result, {}, &EdgeSplit::ends);
    return result;
  }

  dvec3 area(std::uint32_t group) const {
    dvec3 sum(0.0);
    for (const std::uint32_t t : triangles(group)) sum += area_vector(vertices_, facets_.triangles[t]);
    return sum;
  }

  /// Whether both lie in one plane, that of the largest triangle of `a`.
  bool in_one_plane(std::uint32_t a, std::uint32_t b) const {
    dvec3 normal(0.0), origin(0.0);
    for (const std::uint32_t t : triangles(a)) {
      const dvec3 here = area_vector(vertices_, facets_.triangles[t]);
      if (glm::length(here) <= glm::length(normal)) continue;
      normal = here, origin = vertices_[facets_.triangles[t][0]];
    }
    const double most = flat_per_weld * distance_ * glm::length(normal);
    const auto lies_in_it = [&](std::uint32_t t) {
      return std::ranges::all_of(facets_.triangles[t],
                                 [&](std::uint32_t v) { return std::abs(glm::dot(vertices_[v] - origin, normal)) <= most; });
    };
    return std::ranges::all_of(triangles(a), lies_in_it) && std::ranges::all_of(triangles(b), lies_in_it);
  }

  /// Whether a surface runs back along itself here, at the end of a slit or as a fin: `a` folds onto `b` at one edge, and at
  /// another one a face that is not doubled itself goes on.
  bool runs_back(std::uint32_t a, std::uint32_t b, const std::vector<bool>& doubled) const {
    bool folds = false, goes_on = false;
    for (const auto& [number, ends] : outline(a)) {
      const auto sides = edges_[edges_.find(ends.first, ends.second)].sides;
      const auto is_of = [&](std::uint32_t group) {
        return std::ranges::any_of(sides, [&](const EdgeTable::Side& side) { return group_[side.triangle] == group; });
      };
      folds = folds || (sides.size() == 2 && is_of(b));
      goes_on =
          goes_on || std::ranges::any_of(sides, [&](const EdgeTable::Side& side) { return !doubled[group_[side.triangle]]; });
    }
    return folds && goes_on;
  }

  /// All corners are on the outline, as those of a polygon in the file.
  bool is_polygon(std::uint32_t group) const { return triangles(group).size() + 2 == outline(group).size(); }

 private:
  // Entries that begin with this number, of a sorted list. As a span: clang 14 does not know the subranges of GCC 12's library.
  template <class Entry>
  static std::span<const Entry> entries_of(const std::vector<Entry>& entries, std::uint32_t first) {
    const auto first_of = [](const Entry& entry) { return entry.first; };
    return {std::ranges::lower_bound(entries, first, {}, first_of), std::ranges::upper_bound(entries, first, {}, first_of)};
  }

  bool alike(std::uint32_t a, std::uint32_t b) const {
    return facets_.material(a) == facets_.material(b) && (facets_.parts.empty() || facets_.parts[a] == facets_.parts[b]);
  }

  dvec3 apex(const EdgeTable::Side& side) const { return vertices_[facets_.triangles[side.triangle][(side.corner + 2) % 3]]; }

  bool is_corner(const std::vector<Ends>& steps, std::uint32_t vertex) const {
    const auto on = entries_of(steps, vertex);
    if (on.size() != 2) return true;
    const dvec3 &a = vertices_[on[0].second], &b = vertices_[on[1].second], &v = vertices_[vertex];
    return glm::dot(a - v, b - v) >= 0.0 || height(vertices_, {on[0].second, vertex, on[1].second}) > distance_;
  }

  /// Each once, from its lower end.
  void add_chain(const std::vector<Ends>& steps, std::uint32_t from, std::uint32_t to, Chains& chains) const {
    EdgeSplit chain{from, to, {}};
    for (std::uint32_t before = from; !is_corner(steps, chain.high);) {
      chain.vertices.push_back(chain.high);
      const auto on = entries_of(steps, chain.high);
      const std::uint32_t next = on[0].second == before ? on[1].second : on[0].second;
      before = std::exchange(chain.high, next);
    }
    if (chain.low < chain.high) chains.push_back(std::move(chain));
  }

  std::span<const dvec3> vertices_;
  const Facets& facets_;
  double distance_;
  EdgeTable edges_;
  std::vector<std::uint32_t> group_;                      // [triangle]
  TriangleRows members_;                                  // of each group
  std::vector<std::pair<std::uint32_t, Ends>> outlines_;  // group, edge
};

bool same_ends(const Chains& a, const Chains& b) { return std::ranges::equal(a, b, {}, &EdgeSplit::ends, &EdgeSplit::ends); }

bool same_vertices(const Chains& a, const Chains& b) {
  return std::ranges::equal(a, b, {}, &EdgeSplit::vertices, &EdgeSplit::vertices);
}

std::uint64_t hash_of(const Chains& chains) {
  std::uint64_t hash = 0;
  for (const EdgeSplit& chain : chains) {
    const std::uint64_t ends = (std::uint64_t{chain.low} << 32 | chain.high) * 0x9E3779B97F4A7C15u;
    hash = (hash ^ ends ^ (ends >> 29)) * 0xBF58476D1CE4E5B9u;
  }
  return hash;
}

/// Groups whose outlines have the same corners, those with most triangles first.
std::vector<std::vector<std::uint32_t>> groups_of_one_outline(const FaceGroups& groups) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> hashes;
  for (std::uint32_t group = 0; group < groups.size(); ++group)
    if (std::ranges::size(groups.outline(group)) > 2) hashes.emplace_back(hash_of(groups.chains(group)), group);
  std::ranges::sort(hashes);
  std::vector<std::vector<std::uint32_t>> found;
  for (auto begin = hashes.begin(), end = begin; begin != hashes.end(); begin = end) {
    end = std::find_if(begin, hashes.end(), [&](const auto& entry) { return entry.first != begin->first; });
    if (end - begin < 2) continue;
    std::vector<std::uint32_t>& alike = found.emplace_back();
    for (auto entry = begin; entry != end; ++entry) alike.push_back(entry->second);
    std::ranges::stable_sort(alike, std::greater(), [&](std::uint32_t group) { return groups.triangles(group).size(); });
  }
  return found;
}

/// Splits the edges along each side of one outline at the vertices that the other one has there.
void add_splits(std::span<const dvec3> vertices, const Chains& outline, const Chains& other, std::vector<EdgeSplit>& splits) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const EdgeSplit& chain = outline[i];
    const dvec3 along = vertices[chain.high] - vertices[chain.low];
    const auto position = [&](std::uint32_t v) { return glm::dot(vertices[v], along); };
    std::vector<std::uint32_t> path = {chain.low};
    path.insert(path.end(), chain.vertices.begin(), chain.vertices.end());
    path.push_back(chain.high);
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      std::vector<std::uint32_t> between;
      for (const std::uint32_t v : other[i].vertices)
        if (position(v) > position(path[k]) && position(v) < position(path[k + 1]) && v != path[k] && v != path[k + 1])
          between.push_back(v);
      if (between.empty()) continue;
      if (path[k] > path[k + 1]) std::ranges::reverse(between);
      splits.push_back({std::min(path[k], path[k + 1]), std::max(path[k], path[k + 1]), std::move(between)});
    }
  }
}

/// One split for an edge, the first of those that its faces ask for; others follow in a later round.
void split_edges(std::vector<EdgeSplit> splits, Facets& facets, MeshReport& report) {
  std::ranges::stable_sort(splits, {}, &EdgeSplit::ends);
  const auto repeated =
      std::unique(splits.begin(), splits.end(), [&](const EdgeSplit& a, const EdgeSplit& b) { return a.ends() == b.ends(); });
  splits.erase(repeated, splits.end());
  apply_splits(std::move(splits), facets, report);
}

std::vector<Triangle> corners_of(const FaceGroups& groups, const Facets& facets, std::uint32_t group) {
  std::vector<Triangle> all;
  for (const std::uint32_t t : groups.triangles(group)) {
    Triangle& corners = all.emplace_back(facets.triangles[t]);
    std::ranges::sort(corners);
  }
  std::ranges::sort(all);
  return all;
}

/// Puts the triangles of other groups, wound as its own, where the first one of a group stood.
void replace_triangles(const FaceGroups& groups, const std::vector<std::uint32_t>& pattern, Facets& facets, MeshReport& report) {
  Facets result;
  std::vector<bool> done(groups.size(), false);
  for (std::uint32_t i = 0; i < facets.triangles.size(); ++i) {
    const std::uint32_t group = groups.group_of(i), other = pattern[group];
    if (other == group) result.add(facets.triangles[i], facets, i);
    if (other == group || done[group]) continue;
    done[group] = true;
    const bool turned = glm::dot(groups.area(group), groups.area(other)) < 0.0;
    for (const std::uint32_t t : groups.triangles(other)) {
      const auto& [a, b, c] = facets.triangles[t];
      result.add(turned ? Triangle{a, c, b} : Triangle{a, b, c}, facets, i);
    }
  }
  report.triangles_added += result.triangles.size() - facets.triangles.size();
  facets = std::move(result);
}

/// One round; whether edges were split, so that another one is needed.
bool align(std::span<const dvec3> vertices, const FaceGroups& groups, Facets& facets, MeshReport& report) {
  std::vector<EdgeSplit> splits;
  std::vector<std::uint32_t> pattern(groups.size());
  for (std::uint32_t group = 0; group < pattern.size(); ++group) pattern[group] = group;
  bool replaces = false;
  const std::vector<std::vector<std::uint32_t>> all = groups_of_one_outline(groups);
  std::vector<bool> doubled(groups.size(), false);
  for (const std::vector<std::uint32_t>& alike : all)
    for (const std::uint32_t group : alike) doubled[group] = true;
  for (const std::vector<std::uint32_t>& alike : all) {
    const Chains first = groups.chains(alike[0]);
    for (std::size_t i = 1; i < alike.size(); ++i) {
      const Chains other = groups.chains(alike[i]);
      const bool flat = groups.in_one_plane(alike[0], alike[i]), same = same_vertices(first, other);
      if (groups.runs_back(alike[0], alike[i], doubled)) continue;
      if (!same_ends(first, other) || !(flat || (same && groups.is_polygon(alike[0]) && groups.is_polygon(alike[i])))) continue;
      if (!same) {
        add_splits(vertices, first, other, splits);
        add_splits(vertices, other, first, splits);
      } else if (corners_of(groups, facets, alike[0]) != corners_of(groups, facets, alike[i])) {
        pattern[alike[i]] = alike[0];
        replaces = true;
      }
    }
  }
  const bool again = !splits.empty();
  if (again)
    split_edges(std::move(splits), facets, report);
  else if (replaces)
    replace_triangles(groups, pattern, facets, report);
  return again;
}

/// From the line of an edge to a point, square to it.
dvec3 away_from(const EdgeTable::Edge& edge, std::span<const dvec3> vertices, const dvec3& point) {
  const dvec3 along = vertices[edge.high] - vertices[edge.low], way = point - vertices[edge.low];
  return way - glm::dot(way, along) / glm::dot(along, along) * along;
}

/// Two faces of one outline share its corners. There either an edge has more than two sides, or both meet at a fold, or the
/// vertex has two fans of triangles that no edge joins; a surface without any of these lies on itself nowhere.
bool may_lie_on_itself(std::span<const dvec3> vertices, const Facets& facets, const EdgeTable& edges) {
  std::size_t count = 3 * facets.triangles.size();
  DisjointSets fans(count);  // of corners
  const double fold = std::cos(2.0 * most_warp);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const EdgeTable::Edge edge = edges[e];
    if (edge.sides.size() == 1) continue;
    if (edge.sides.size() > 2) return true;
    std::array<dvec3, 2> ways;
    std::array<std::array<std::uint32_t, 2>, 2> corners;  // at the lower vertex, at the higher one
    for (int i = 0; i < 2; ++i) {
      const auto [triangle, corner] = edge.sides[i];
      const Triangle& t = facets.triangles[triangle];
      ways[i] = away_from(edge, vertices, vertices[t[(corner + 2) % 3]]);
      const std::uint32_t here = 3 * triangle + corner, next = 3 * triangle + (corner + 1) % 3;
      corners[i] = t[corner] == edge.low ? std::array{here, next} : std::array{next, here};
    }
    const double cosine = glm::dot(ways[0], ways[1]);
    if (cosine > 0.0 && cosine * cosine > fold * fold * glm::dot(ways[0], ways[0]) * glm::dot(ways[1], ways[1])) return true;
    for (int end = 0; end < 2; ++end) {
      if (fans.root(corners[0][end]) != fans.root(corners[1][end])) --count;
      fans.join(corners[1][end], corners[0][end]);
    }
  }
  std::vector<bool> used(vertices.size(), false);
  for (const Triangle& t : facets.triangles)
    for (const std::uint32_t corner : t) used[corner] = true;
  return count > static_cast<std::size_t>(std::ranges::count(used, true));
}

}  // namespace

void align_coincident_faces(std::span<const dvec3> vertices, const EdgeTable& edges, double distance, Facets& facets,
                            MeshReport& report) {
  if (!may_lie_on_itself(vertices, facets, edges)) return;
  const auto goes_on = [&](const EdgeTable::Edge& edge, const dvec3& a, const dvec3& b) {
    const dvec3 one = away_from(edge, vertices, a), other = away_from(edge, vertices, b);
    const double across = glm::length(glm::cross(one, other)), flat = flat_per_weld * distance;
    return glm::dot(one, other) < 0.0 && across <= flat * std::min(glm::length(one), glm::length(other));
  };
  const auto bends_little = [&](const EdgeTable::Edge& edge, const dvec3& a, const dvec3& b) {
    const dvec3 one = away_from(edge, vertices, a), other = away_from(edge, vertices, b);
    return glm::dot(one, other) < -std::cos(most_warp) * glm::length(one) * glm::length(other);
  };
  for (int round = 0; round < most_align_rounds; ++round)
    if (!align(vertices, FaceGroups(vertices, facets, distance, goes_on), facets, report)) break;
  align(vertices, FaceGroups(vertices, facets, distance, bends_little), facets, report);
}

}  // namespace raytube
