// Which cells of a tile have the target under them.
#pragma once

#include <algorithm>
#include <vector>

#include "mesh/model/face_tree.h"
#include "sbr/beams/beam.h"
#include "sbr/launch/tile.h"

namespace raytube {

/// Marks the cells whose ray can meet the target, and perhaps a few more: the faces whose boxes reach into the tile, projected
/// and filled row by row. Where that would take longer than to trace the cells, all are marked.
class Coverage {
 public:
  /// Columns [begin, end); none if they are equal.
  struct Span {
    std::uint32_t begin, end;
  };

  /// Without `faces` every cell is covered.
  Coverage(const FaceTree* faces, const LaunchGrid& grid, const CellBlock& tile);

  /// The first covered cells of a row at or after a column.
  Span next(std::uint32_t row, std::uint32_t column) const;
  std::uint64_t empty_cells() const { return static_cast<std::uint64_t>(std::ranges::count(cells_, 0)); }

 private:
  std::size_t index(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row - tile_.row_begin} * (tile_.column_end - tile_.column_begin) + (column - tile_.column_begin);
  }
  void mark(const FaceTree& faces, std::uint32_t face);
  void mark_row(std::uint32_t row, double low, double high);

  const LaunchGrid& grid_;
  const CellBlock& tile_;
  Beam beam_;      // as launched, without fields
  double margin_;  // [m]
  std::vector<std::uint8_t> cells_;
  std::vector<dvec2> corners_;
};

}  // namespace raytube
