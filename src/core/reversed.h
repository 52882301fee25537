// Ranges from their end to their beginning.
#pragma once

#include <iterator>

namespace raytube {

/// For loops over `range`, which must outlive this. std::views::reverse is not for clang 14 with libstdc++ 12.
template <class Range>
struct Reversed {
  const Range& range;
  auto begin() const { return std::rbegin(range); }
  auto end() const { return std::rend(range); }
};

template <class Range>
Reversed<Range> reversed(const Range& range) {
  return {range};
}

}  // namespace raytube
