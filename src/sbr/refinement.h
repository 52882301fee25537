// Which blocks of a part of a look are traced again, and how much more densely.
#pragma once

#include <cstddef>
#include <vector>

namespace raytube {

/// What sampling left in a block: how many times what the whole part may have, and whether it can be made better.
struct BlockError {
  double excess;
  bool refinable;
};

struct Refinement {
  std::vector<std::size_t> blocks;  // in rising order; empty: none can be made better
  double growth = 1.0;              // of the cells per wavelength
};

/// `whole` is the excess of the part: more than the blocks' squares add up to where their errors are alike. The errors fall with
/// the power `order` of the cells' width.
Refinement refinement(const std::vector<BlockError>& errors, double whole, double order);

}  // namespace raytube
