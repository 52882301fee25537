// The cube root, for sums of many.
#pragma once

#include <bit>
#include <cstdint>

namespace raytube {

/// Of a positive number; relative error below 2e-16 (Kahan's cbrt, as in FreeBSD's libm: a third of the exponent, a polynomial
/// and one step of Newton from a root of 23 bits, whose square is exact).
inline double cube_root(double x) {
  double root = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 3 + 0x2a9f789300000000);
  const double r = root * root * (root / x);
  root *= 1.87595182427177009643 + r * (-1.88497979543377169875 + r * 1.621429720105354466140) +
          r * r * r * (-0.758397934778766047437 + r * 0.145996192886612446982);
  root = std::bit_cast<double>((std::bit_cast<std::uint64_t>(root) + 0x80000000) & 0xffffffffc0000000);
  const double other = x / (root * root);
  return root + root * ((other - root) / (root + root + other));
}

}  // namespace raytube
