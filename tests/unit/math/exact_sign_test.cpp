// Signs of volumes against integers of any length.
#include "math/exact_sign.h"

#include <CGAL/Mpzf.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raytube {
namespace {

int by_integers(const dvec3& d, const dvec3& o, const dvec3& a, const dvec3& b) {
  using Exact = CGAL::Mpzf;
  const auto from = [&](const dvec3& r, int axis) { return Exact(r[axis]) - Exact(o[axis]); };
  Exact volume = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    volume = volume + Exact(d[i]) * (from(a, j) * from(b, k) - from(a, k) * from(b, j));
  }
  return CGAL::sign(volume);
}

// Rays that run through an edge, or by so little beside it that no double holds the volume: of coordinates with few digits, with
// all of them, and of very different sizes.
TEST(ExactSign, IsThatOfIntegers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::uniform_int_distribution<int> whole(-8, 8), digit(-1, 1), exponent(-60, 60);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool few_digits = i % 2 == 0;
    const double scale = i % 5 == 0 ? std::ldexp(1.0, exponent(random)) : 1.0;
    const auto point = [&] {
      return few_digits ? scale * dvec3(whole(random), whole(random), whole(random))
                        : scale * dvec3(number(random), number(random), number(random));
    };
    const dvec3 o = point(), a = point(), b = point();
    const double share = few_digits ? 0.5 : number(random);
    dvec3 d = a + share * (b - a) - o;  // towards a point of the edge, but for rounding
    for (int axis = 0; axis < 3; ++axis)
      if (digit(random) == 1) d[axis] = std::nextafter(d[axis], 2.0 * d[axis]);
    const int sign = by_integers(d, o, a, b);
    EXPECT_EQ(exact_side(d, o, a, b), sign);
    EXPECT_EQ(exact_side(d, o, b, a), -sign);
    zeros += sign == 0;
  }
  EXPECT_GT(zeros, 1000);  // or nothing was tried
}

TEST(ExactSign, NumbersOfAnySize) {
  const dvec3 o(0.0), d(0.0, 0.0, 1e-300);
  EXPECT_EQ(exact_side(d, o, {1e-300, 0.0, 0.0}, {0.0, 1e-300, 0.0}), 1);
  EXPECT_EQ(exact_side(d, o, {0.0, 1e300, 0.0}, {1e300, 0.0, 0.0}), -1);
  EXPECT_EQ(exact_side(d, o, {1e-300, 1e-300, 0.0}, {1e300, 1e300, 0.0}), 0);
}

}  // namespace
}  // namespace raytube
