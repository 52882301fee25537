// Dense matrices. Eigen asks the processor for the sizes of its caches and cuts products into blocks that fit, so that the order
// of sums would hang on the machine; here the sizes are those of a usual processor on all.
#pragma once

#include <Eigen/Dense>

namespace raytube {

inline const bool blocks_of_products_are_fixed = [] {
  Eigen::setCpuCacheSizes(32 << 10, 512 << 10, 8 << 20);
  return true;
}();

}  // namespace raytube
