#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "mesh/model/edge_table.h"
#include "mesh/repair/steps.h"

namespace raytube {

namespace {

struct Key {
  Triangle corners;  // ascending
  bool odd;          // winding: an odd permutation of `corners`
  std::uint32_t triangle;
  friend auto operator<=>(const Key&, const Key&) = default;
};

Key key_of(const Triangle& t, std::uint32_t index) {
  Key key{t, false, index};
  const auto order = [&](int i, int k) {
    if (key.corners[i] <= key.corners[k]) return;
    std::swap(key.corners[i], key.corners[k]);
    key.odd = !key.odd;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return key;
}

/// Two triangles with the same corners and opposite windings.
struct Pair {
  std::uint32_t first, second;
};

struct Coincident {
  std::vector<Key> keys;       // ascending
  std::vector<bool> repeated;  // same winding as an earlier triangle
  std::vector<Pair> pairs;
};

Coincident find_coincident(std::span<const Triangle> triangles) {
  std::vector<Key> keys;
  keys.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) keys.push_back(key_of(triangles[i], i));
  std::sort(keys.begin(), keys.end());
  Coincident found{{}, std::vector<bool>(triangles.size(), false), {}};
  std::size_t kept = 0;  // the last key that repeats no earlier one
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const bool same_corners = keys[i].corners == keys[kept].corners;
    if (same_corners && keys[i].odd == keys[kept].odd) {
      found.repeated[keys[i].triangle] = true;
      continue;
    }
    if (same_corners)
      found.pairs.push_back({std::min(keys[kept].triangle, keys[i].triangle), std::max(keys[kept].triangle, keys[i].triangle)});
    kept = i;
  }
  found.keys = std::move(keys);
  return found;
}

/// For each edge of these triangles: two of them or more meet there, and none hangs together with a border or with what lets
/// waves through.
std::vector<bool> closed_edges(const Facets& facets, std::span<const Material> materials, const EdgeTable& edges) {
  const auto region = connected_groups(edges, facets.triangles.size(), [](const auto& edge) { return edge.sides.size() == 2; });
  std::vector<bool> open(facets.triangles.size(), false);  // [region]
  for (std::size_t i = 0; i < region.size(); ++i)
    if (transmits(materials, facets.material(i))) open[region[i]] = true;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].sides.size() == 1) open[region[edges[e].sides[0].triangle]] = true;
  std::vector<bool> closed(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e)
    closed[e] = edges[e].sides.size() > 1 &&
                std::ranges::none_of(edges[e].sides, [&](const auto& side) { return open[region[side.triangle]]; });
  return closed;
}

/// For each pair: whether its group of connected pairs is a wall inside closed bodies. It is if it has a border and the
/// other triangles, which coincide with none, close around the border; a free border or an open surface around it speak for an
/// open surface.
std::vector<bool> internal_walls(std::span<const Triangle> walls, const Facets& others, std::span<const Material> materials,
                                 std::size_t vertex_count) {
  const EdgeTable edges(walls, vertex_count), edges_around(others.triangles, vertex_count);
  const std::vector<bool> closed_around = closed_edges(others, materials, edges_around);
  const auto group = connected_groups(edges, walls.size(), [](const auto&) { return true; });
  std::vector<bool> has_border(walls.size(), false), enclosed(walls.size(), true);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [low, high, sides] = edges[e];
    if (sides.size() > 1) continue;
    const std::size_t around = edges_around.find(low, high);
    has_border[group[sides[0].triangle]] = true;
    if (around == edges_around.size() || !closed_around[around]) enclosed[group[sides[0].triangle]] = false;
  }
  std::vector<bool> internal(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) internal[i] = has_border[group[i]] && enclosed[group[i]];
  return internal;
}

/// Triangles left out though made of something else than the one with the same corners that stays.
std::uint64_t count_of_other_material(std::span<const Key> keys, const std::vector<bool>& dropped, const Facets& facets) {
  std::uint64_t count = 0;
  for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
    while (end < keys.size() && keys[end].corners == keys[begin].corners) ++end;
    const auto alike = keys.subspan(begin, end - begin);
    const auto stays = std::ranges::find_if(alike, [&](const Key& key) { return !dropped[key.triangle]; });
    if (stays == alike.end()) continue;
    const std::uint32_t material = facets.material(stays->triangle);
    count += std::ranges::count_if(alike, [&](const Key& key) { return facets.material(key.triangle) != material; });
  }
  return count;
}

/// Without its wall a solid would be one body with what it touches.
void check_wall(std::span<const Material> materials, std::uint32_t one, std::uint32_t other) {
  if (one == other || (!is_solid(materials, one) && !is_solid(materials, other))) return;
  const std::uint32_t solid = is_solid(materials, one) ? one : other, beside = solid == one ? other : one;
  throw InputError(fmt::format(
      "material \"{}\" of kind \"solid\" shares a face and its corners with a body of {}; leave a gap between them, for which a "
      "hundredth of a wavelength will do",
      quotable(materials[solid].name), material_text(materials, beside)));
}

}  // namespace

void drop_duplicates(Facets& facets, std::span<const Material> materials, std::size_t vertex_count, MeshReport& report) {
  const std::vector<Triangle>& triangles = facets.triangles;
  const Coincident found = find_coincident(triangles);
  std::vector<bool> dropped = found.repeated, paired = found.repeated;
  report.triangles_duplicate += std::count(dropped.begin(), dropped.end(), true);

  std::vector<Triangle> walls;
  for (const Pair& pair : found.pairs) {
    paired[pair.first] = paired[pair.second] = true;
    walls.push_back(triangles[pair.first]);
  }
  if (!walls.empty()) {
    Facets others;
    for (std::size_t i = 0; i < triangles.size(); ++i)
      if (!paired[i]) others.add(triangles[i], facets, i);
    const std::vector<bool> internal = internal_walls(walls, others, materials, vertex_count);
    for (std::size_t i = 0; i < walls.size(); ++i) {
      const auto [first, second] = found.pairs[i];
      dropped[second] = true;
      if (internal[i]) dropped[first] = true, check_wall(materials, facets.material(first), facets.material(second));
      (internal[i] ? report.triangles_internal += 2 : report.triangles_duplicate += 1);
    }
  }
  if (!facets.materials.empty()) report.duplicates_of_other_material += count_of_other_material(found.keys, dropped, facets);
  facets.drop_if([&](std::size_t i) { return dropped[i]; });
}

}  // namespace raytube
