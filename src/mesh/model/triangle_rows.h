// Lists of triangles, one after the other.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace raytube {

/// A list of triangles for each number, compressed rows.
struct TriangleRows {
  std::vector<std::uint32_t> first, triangles;  // row r is triangles[first[r]] to triangles[first[r + 1] - 1]

  /// The triangles of a row.
  std::span<const std::uint32_t> operator[](std::uint32_t row) const {
    return {triangles.data() + first[row], triangles.data() + first[row + 1]};
  }
  /// Number of rows.
  std::uint32_t size() const { return static_cast<std::uint32_t>(first.size() - 1); }
};

/// In each row, in ascending order, the triangles that have its number among `numbers_of` them.
template <class PerTriangle, class NumbersOf>
TriangleRows triangle_rows(std::size_t count, const PerTriangle& per_triangle, NumbersOf numbers_of) {
  TriangleRows result{std::vector<std::uint32_t>(count + 1, 0), {}};
  for (const auto& of : per_triangle)
    for (const std::uint32_t row : numbers_of(of)) ++result.first[row + 1];
  for (std::size_t row = 1; row <= count; ++row) result.first[row] += result.first[row - 1];
  result.triangles.resize(result.first.back());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t t = 0; t < per_triangle.size(); ++t)
    for (const std::uint32_t row : numbers_of(per_triangle[t])) result.triangles[next[row]++] = t;
  return result;
}

/// The triangles of each number, of which every triangle has one.
inline TriangleRows triangle_rows(std::size_t count, const std::vector<std::uint32_t>& number_of) {
  return triangle_rows(count, number_of, [](std::uint32_t number) { return std::array{number}; });
}

}  // namespace raytube
