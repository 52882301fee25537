// Counts with their noun.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace raytube {

/// "1 wedge", "2 wedges", "0 wedges"; "2 frequencies" with the plural given.
inline std::string count_text(std::uint64_t count, std::string_view noun, std::string_view plural = "") {
  if (count == 1) return fmt::format("1 {}", noun);
  return plural.empty() ? fmt::format("{} {}s", count, noun) : fmt::format("{} {}", count, plural);
}

}  // namespace raytube
