// Many numbers as a page reads them: base64 of little-endian bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace raytube {

/// Levels [dB] in hundredths as Int16, which is finer than a page shows: -327.68 stands for -inf and whatever is weaker.
std::string packed_levels(const std::vector<double>& levels_db);

/// As Float32.
std::string packed_floats(const std::vector<double>& values);

/// As Uint32.
std::string packed_indices(const std::vector<std::uint32_t>& indices);

}  // namespace raytube
