#include "math/exact_sign.h"

#include <CGAL/Mpzf.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace raytube {

namespace {

// Two numbers whose sum is the exact result of an operation on doubles.
struct Exactly {
  double high, low;
};

// Knuth, The Art of Computer Programming 2, section 4.2.2, theorem B.
Exactly sum(double a, double b) {
  const double high = a + b, of_b = high - a;
  return {high, (a - (high - of_b)) + (b - of_b)};
}

// Dekker 1971, Numer. Math. 18, 224. Valid where neither the product nor its low half over- or underflows.
Exactly product(double a, double b) {
  const auto split = [](double x) {
    const double c = 134217729.0 * x, high = c - (c - x);  // 2^27 + 1
    return Exactly{high, x - high};
  };
  const double high = a * b;
  const Exactly x = split(a), y = split(b);
  return {high, x.low * y.low - (((high - x.high * y.high) - x.low * y.high) - x.high * y.low)};
}

// A sum without rounding: doubles of rising magnitude that do not overlap, so that the last one has its sign (Shewchuk 1997,
// Discrete Comput. Geom. 18, 305, grow-expansion with elimination of zeros).
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const Exactly grown = sum(x, parts_[i]);
      if (grown.low != 0.0) parts_[kept++] = grown.low;
      x = grown.high;
    }
    if (x != 0.0) parts_[kept++] = x;
    size_ = kept;
  }

  // Adds a b c.
  void add_product(double a, double b, double c) {
    if (a == 0.0 || b == 0.0 || c == 0.0) return;
    const Exactly ab = product(a, b), high = product(ab.high, c);
    add(high.low), add(high.high);
    if (ab.low != 0.0) {
      const Exactly low = product(ab.low, c);
      add(low.low), add(low.high);
    }
    is_exact_ = is_exact_ && is_moderate(a) && is_moderate(b) && is_moderate(c);
  }

  // False if a product may have left the range in which it is exact.
  bool is_exact() const { return is_exact_; }
  int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0.0 ? 1 : -1; }

 private:
  // Products of three such numbers are below 1e270, and their last bits, of 159, above 1e-318: doubles go down to 5e-324.
  static bool is_moderate(double x) { return std::abs(x) > 1e-90 && std::abs(x) < 1e90; }

  // Six products, of differences in two parts each, of four numbers each.
  std::array<double, 6 * 4 * 4> parts_;
  std::size_t size_ = 0;
  bool is_exact_ = true;
};

int sign_by_integers(const dvec3& direction, const dvec3& origin, const dvec3& a, const dvec3& b) {
  using Exact = CGAL::Mpzf;
  Exact to_a[3], to_b[3];
  for (int axis = 0; axis < 3; ++axis) {
    to_a[axis] = Exact(a[axis]) - Exact(origin[axis]);
    to_b[axis] = Exact(b[axis]) - Exact(origin[axis]);
  }
  Exact volume = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    volume = volume + Exact(direction[axis]) * (to_a[next] * to_b[last] - to_a[last] * to_b[next]);
  }
  return CGAL::sign(volume);
}

}  // namespace

int exact_side(const dvec3& direction, const dvec3& origin, const dvec3& a, const dvec3& b) {
  std::array<Exactly, 3> to_a, to_b;
  for (int axis = 0; axis < 3; ++axis) to_a[axis] = sum(a[axis], -origin[axis]), to_b[axis] = sum(b[axis], -origin[axis]);
  ExactSum volume;
  const auto add = [&](double factor, const Exactly& x, const Exactly& y) {
    for (const double of_x : {x.high, x.low})
      for (const double of_y : {y.high, y.low}) volume.add_product(of_x, of_y, factor);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    add(direction[axis], to_a[next], to_b[last]);
    add(-direction[axis], to_a[last], to_b[next]);
  }
  return volume.is_exact() ? volume.sign() : sign_by_integers(direction, origin, a, b);
}

}  // namespace raytube
