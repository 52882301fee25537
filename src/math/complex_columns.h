// Rows of complex numbers, worked through a few at a time. What a sum gives depends on its terms and their number alone.
#pragma once

#include <array>
#include <vector>

#include "math/lanes.h"

namespace raytube {

/// Complex numbers in a row, real and imaginary parts apart, with room for a whole number of blocks of `lanes`.
struct ComplexColumn {
  std::vector<double> re, im;

  void make_room(std::size_t size);  // never less than there is
  Complex operator[](std::size_t i) const { return {re[i], im[i]}; }
  void set(std::size_t i, Complex value) {
    re[i] = value.real();
    im[i] = value.imag();
  }
};

/// A number of a column, and those that follow it.
struct ColumnView {
  const double *re, *im;
  ColumnView(const ComplexColumn& column, std::size_t first) : re(column.re.data() + first), im(column.im.data() + first) {}
};

void store(const Complexes& values, ComplexColumn& column, std::size_t first);
Complexes load(const ComplexColumn& column, std::size_t first);

/// sum += a b, number by number.
void add_products(Complexes& sum, const Complexes& a, const Complexes& b);

/// Sum of `count` numbers, and of the products of as many pairs.
Complex sum(ColumnView values, std::size_t count);
Complex sum_of_products(ColumnView a, ColumnView b, std::size_t count);

/// The products of two rows with two others: [p][q] is the sum over a[p] b[q].
using PairSums = std::array<std::array<Complex, 2>, 2>;
PairSums sums_of_products(const std::array<ColumnView, 2>& a, const std::array<ColumnView, 2>& b, std::size_t count);

/// to[first + i] = factor a[i]; factor a[i] b[i].
void scale(ColumnView a, Complex factor, std::size_t count, ComplexColumn& to, std::size_t first);
void multiply(ColumnView a, ColumnView b, std::size_t count, ComplexColumn& to, std::size_t first);

/// to[first + i] = a[i] (b.factor b[i] + c.factor c[i]).
struct ScaledColumn {
  double factor;
  ColumnView column;
};
void multiply_by_sum(ColumnView a, ScaledColumn b, ScaledColumn c, std::size_t count, ComplexColumn& to, std::size_t first);

}  // namespace raytube
