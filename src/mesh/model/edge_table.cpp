#include "mesh/model/edge_table.h"

#include <algorithm>

namespace raytube {

namespace {

struct Slot {
  std::uint32_t high;
  std::uint32_t side;  // 3 * triangle + corner
};

/// Sides bucketed by their lower vertex; bucket v holds slots begin[v] .. begin[v + 1].
struct Buckets {
  std::vector<std::uint32_t> begin;
  std::vector<Slot> slots;
};

Buckets bucket_by_lower_vertex(std::span<const Triangle> triangles, std::size_t vertex_count) {
  Buckets buckets{std::vector<std::uint32_t>(vertex_count + 1), std::vector<Slot>(3 * triangles.size())};
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++buckets.begin[std::min(t[k], t[(k + 1) % 3]) + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) buckets.begin[v + 1] += buckets.begin[v];
  std::vector<std::uint32_t> next(buckets.begin.begin(), buckets.begin.end() - 1);
  std::uint32_t side = 0;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k, ++side) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      buckets.slots[next[low]++] = {high, side};
    }
  return buckets;
}

}  // namespace

EdgeTable::EdgeTable(std::span<const Triangle> triangles, std::size_t vertex_count) : edge_of_side_(3 * triangles.size()) {
  Buckets buckets = bucket_by_lower_vertex(triangles, vertex_count);
  sides_.reserve(buckets.slots.size());
  ends_.reserve(buckets.slots.size() / 2 + 1);  // as many as a closed surface has
  for (std::uint32_t low = 0; low < vertex_count; ++low) {
    const auto begin = buckets.slots.begin() + buckets.begin[low], end = buckets.slots.begin() + buckets.begin[low + 1];
    std::sort(begin, end, [](const Slot& a, const Slot& b) { return a.high != b.high ? a.high < b.high : a.side < b.side; });
    for (auto slot = begin; slot != end; ++slot) {
      if (slot == begin || slot->high != (slot - 1)->high)
        ends_.push_back({low, slot->high, static_cast<std::uint32_t>(sides_.size())});
      edge_of_side_[slot->side] = static_cast<std::uint32_t>(ends_.size() - 1);
      sides_.emplace_back(slot->side / 3, slot->side % 3);
    }
  }
}

EdgeTable::Edge EdgeTable::operator[](std::size_t edge) const {
  const std::size_t first = ends_[edge].first_side;
  const std::size_t last = edge + 1 < ends_.size() ? ends_[edge + 1].first_side : sides_.size();
  return {ends_[edge].low, ends_[edge].high, std::span(sides_).subspan(first, last - first)};
}

std::size_t EdgeTable::find(std::uint32_t low, std::uint32_t high) const {
  const auto key = std::pair(low, high);
  const auto ends_of = [](const Ends& e) { return std::pair(e.low, e.high); };
  const auto found = std::ranges::lower_bound(ends_, key, {}, ends_of);
  return found != ends_.end() && ends_of(*found) == key ? found - ends_.begin() : ends_.size();
}

}  // namespace raytube
