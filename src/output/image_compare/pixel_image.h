// An image of any source: amplitudes by pixel.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/field.h"
#include "imaging/sweep_grid.h"
#include "output/tables/column_map.h"

namespace raytube {

/// Pixels row by row: columns along `across`, rows along `up`.
struct PixelImage {
  std::filesystem::path file;
  bool placed = false;  // axes are in metres; else they number the pixels
  EvenAxis across, up;  // middles of pixels
  std::array<bool, 4> has_channel{}, has_phase{};
  std::array<std::vector<Complex>, 4> s;  // [m]; without phase |S|

  std::size_t pixels() const { return across.count * up.count; }
};

/// A file, and how its columns are named; `option` is what sentences call the latter.
struct NamedFile {
  std::filesystem::path file;
  ColumnMap map{};
  std::string option{};
};

}  // namespace raytube
