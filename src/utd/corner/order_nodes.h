// The path of integration over the orders nu of a corner's field.
#pragma once

#include <vector>

#include "core/field.h"

namespace raytube {

struct OrderNode {
  Complex nu;
  Complex weight;  // with all that every term has besides its Green's functions
};

/// Around all eigenvalues: in below the real axis, between the poles at 1/2 and the least eigenvalue, and out into the upper half
/// plane, where the integrand falls as e^(-pi Im nu) does. With the Gaussian exp(-(nu / 6)^2) of SheetCorner.
std::vector<OrderNode> nodes_over_orders();

}  // namespace raytube
