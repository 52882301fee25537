#include "mesh/repair/edge_splits.h"

#include <algorithm>
#include <tuple>

namespace raytube {

namespace {

using Path = std::vector<std::uint32_t>;

/// The vertices on the way from a to b.
Path path_between(std::span<const EdgeSplit> splits, std::uint32_t a, std::uint32_t b) {
  const auto key = std::pair(std::min(a, b), std::max(a, b));
  const auto split = std::ranges::lower_bound(splits, key, {}, &EdgeSplit::ends);
  if (split == splits.end() || split->ends() != key) return {};
  return a < b ? split->vertices : Path(split->vertices.rbegin(), split->vertices.rend());
}

/// A triangle with the vertices that lie on its sides; on[k] is the side from corner k to the next.
struct MarkedTriangle {
  Triangle corners;
  std::array<std::span<const std::uint32_t>, 3> on;
};

/// Halves the triangle at a vertex on one side until no side carries any; pieces with repeated corners vanish.
void cut(const MarkedTriangle& t, std::vector<Triangle>& pieces) {
  int k = 0;
  while (k < 3 && t.on[k].empty()) ++k;
  const auto [a, b, c] = std::tuple(t.corners[k % 3], t.corners[(k + 1) % 3], t.corners[(k + 2) % 3]);
  if (k == 3) {
    if (a != b && b != c && c != a) pieces.push_back(t.corners);
    return;
  }
  const std::size_t middle = t.on[k].size() / 2;
  const std::uint32_t v = t.on[k][middle];
  cut({{a, v, c}, {t.on[k].first(middle), {}, t.on[(k + 2) % 3]}}, pieces);
  cut({{v, b, c}, {t.on[k].subspan(middle + 1), t.on[(k + 1) % 3], {}}}, pieces);
}

std::vector<Triangle> pieces_of(const Triangle& t, std::span<const EdgeSplit> splits) {
  std::array<Path, 3> on;
  for (int k = 0; k < 3; ++k) on[k] = path_between(splits, t[k], t[(k + 1) % 3]);
  std::vector<Triangle> pieces;
  cut({t, {on[0], on[1], on[2]}}, pieces);
  return pieces;
}

}  // namespace

void apply_splits(std::vector<EdgeSplit> splits, Facets& facets, MeshReport& report) {
  std::ranges::sort(splits, {}, &EdgeSplit::ends);
  std::vector<std::uint32_t> ends;
  for (const EdgeSplit& s : splits) {
    report.t_junctions_split += s.vertices.size();
    ends.insert(ends.end(), {s.low, s.high});
  }
  std::ranges::sort(ends);
  const auto is_end = [&](std::uint32_t v) { return std::ranges::binary_search(ends, v); };
  Facets result;
  result.triangles.reserve(facets.triangles.size());
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const Triangle& t = facets.triangles[i];
    const std::vector<Triangle> pieces = std::ranges::count_if(t, is_end) >= 2 ? pieces_of(t, splits) : std::vector{t};
    pieces.empty() ? ++report.triangles_degenerate : report.triangles_added += pieces.size() - 1;
    for (const Triangle& piece : pieces) result.add(piece, facets, i);
  }
  facets = std::move(result);
}

}  // namespace raytube
