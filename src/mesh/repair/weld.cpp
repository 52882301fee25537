#include "mesh/repair/weld.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "mesh/model/geometry.h"
#include "mesh/model/triangle_mesh.h"

namespace raytube {

namespace {

/// Kept vertices chained by grid cell. Cells are wide, so that most points ask one cell only, and cell numbers fit 21 bits an
/// axis, so that the key is exact.
class CellGrid {
 public:
  CellGrid(const dvec3& low, double cell) : low_(low), cell_(cell) {}

  using Cell = glm::u64vec3;
  Cell cell_of(const dvec3& p) const { return Cell(glm::max(glm::floor((p - low_) / cell_), 0.0)); }

  void add(std::uint32_t vertex, const dvec3& p) {
    const auto [head, is_new] = first_.try_emplace(key(cell_of(p)), no_index);
    next_.push_back(head->second);
    head->second = vertex;
  }

  template <class Visit>
  void for_each_in(const Cell& cell, Visit visit) const {
    const auto head = first_.find(key(cell));
    for (std::uint32_t v = head == first_.end() ? no_index : head->second; v != no_index; v = next_[v]) visit(v);
  }

 private:
  static std::uint64_t key(const Cell& c) { return c.x | c.y << 21 | c.z << 42; }

  dvec3 low_;
  double cell_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_;
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
  CellGrid grid(bounding_box(points).low, diagonal / 1e6);
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
