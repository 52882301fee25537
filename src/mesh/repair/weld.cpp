#include <algorithm>
#include <bit>
#include <cmath>

#include "mesh/model/geometry.h"
#include "mesh/model/triangle_mesh.h"
#include "mesh/repair/steps.h"

namespace raytube {

namespace {

/// Kept vertices chained by grid cell. Cells are wide, so that most points ask one cell only, and cell numbers fit 21 bits an
/// axis, so that the key is exact.
class CellGrid {
 public:
  CellGrid(const dvec3& low, double cell, std::size_t most_vertices)
      : low_(low), cell_(cell), slots_(std::bit_ceil(2 * most_vertices + 1)) {
    next_.reserve(most_vertices);
  }

  using Cell = glm::u64vec3;
  Cell cell_of(const dvec3& p) const { return Cell(glm::max(glm::floor((p - low_) / cell_), 0.0)); }

  void add(std::uint32_t vertex, const dvec3& p) {
    const std::uint64_t key = key_of(cell_of(p));
    Slot& slot = slots_[slot_of(key)];
    next_.push_back(slot.last);
    slot = {key, vertex};
  }

  template <class Visit>
  void for_each_in(const Cell& cell, Visit visit) const {
    for (std::uint32_t v = slots_[slot_of(key_of(cell))].last; v != no_index; v = next_[v]) visit(v);
  }

 private:
  struct Slot {
    std::uint64_t key = 0;
    std::uint32_t last = no_index;  // vertex of the cell; none: the slot is free
  };

  static std::uint64_t key_of(const Cell& c) { return c.x | c.y << 21 | c.z << 42; }

  /// That of a cell, or the free one where it would be.
  std::size_t slot_of(std::uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (key * 0x9E3779B97F4A7C15u >> 32) & mask;
    while (slots_[slot].last != no_index && slots_[slot].key != key) slot = (slot + 1) & mask;
    return slot;
  }

  dvec3 low_;
  double cell_;
  std::vector<Slot> slots_;  // half of them stay free at least
  std::vector<std::uint32_t> next_;
};

std::uint32_t first_near(const CellGrid& grid, std::span<const dvec3> vertices, const dvec3& p, double distance) {
  const CellGrid::Cell low = grid.cell_of(p - distance), high = grid.cell_of(p + distance);
  std::uint32_t first = no_index;
  for (std::uint64_t x = low.x; x <= high.x; ++x)
    for (std::uint64_t y = low.y; y <= high.y; ++y)
      for (std::uint64_t z = low.z; z <= high.z; ++z)
        grid.for_each_in({x, y, z}, [&](std::uint32_t v) {
          if (glm::distance(vertices[v], p) <= distance) first = std::min(first, v);
        });
  return first;
}

}  // namespace

WeldedPoints weld(std::span<const dvec3> points, double distance, double diagonal) {
  CellGrid grid(bounding_box(points).low, diagonal / 1e6, points.size());
  WeldedPoints welded;
  welded.vertex_of_point.reserve(points.size());
  for (const dvec3& p : points) {
    std::uint32_t vertex = first_near(grid, welded.vertices, p, distance);
    if (vertex == no_index) {
      vertex = static_cast<std::uint32_t>(welded.vertices.size());
      welded.vertices.push_back(p);
      grid.add(vertex, p);
    }
    welded.vertex_of_point.push_back(vertex);
  }
  return welded;
}

}  // namespace raytube
