// Work dealt out to processes that know nothing of one another.
#pragma once

#include <cstddef>

namespace raytube {

/// One part of a sweep's looks: of those that are computed every count-th one, from `index` on.
struct Shard {
  std::size_t index = 0;  // from 0
  std::size_t count = 1;  // of parts

  /// True for a look of this part, by its place among those that are computed.
  bool has(std::size_t look) const { return look % count == index; }
  /// How many of so many looks it has.
  std::size_t size(std::size_t looks) const { return looks > index ? (looks - index - 1) / count + 1 : 0; }
};

}  // namespace raytube
