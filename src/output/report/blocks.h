// Grids of levels made small enough for a page: a block shows the strongest of what lies in it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/field.h"
#include "core/json.h"

namespace raytube {

/// A side of a grid in blocks of `size` values, the last one perhaps shorter.
struct Blocks {
  std::size_t values, size;

  Blocks(std::size_t of_values, std::size_t most)
      : values(of_values), size((of_values + most - 1) / std::max<std::size_t>(most, 1)) {
    size = std::max<std::size_t>(size, 1);
  }
  std::size_t count() const { return (values + size - 1) / size; }
  std::size_t of(std::size_t value) const { return value / size; }
};

/// An even axis in blocks: the middles of the first and the last one.
JsonValue block_axis(double first, double step, const Blocks& blocks);

/// sigma [dBsm] of the four channels over a grid [slow][fast] in blocks, packed.
class BlockLevels {
 public:
  BlockLevels(const Blocks& slow, const Blocks& fast);
  void add(std::size_t slow, std::size_t fast, const std::array<double, 4>& sigma_dbsm);
  void add(std::size_t slow, std::size_t fast, const ScatteringMatrix& s);
  /// A list of the four channels.
  JsonValue json() const;

 private:
  Blocks slow_, fast_;
  std::array<std::vector<double>, 4> levels_;
};

}  // namespace raytube
