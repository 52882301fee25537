#include "math/complex_columns.h"

#include <cstring>

namespace raytube {

namespace {

constexpr std::size_t stride = 4;  // sums side by side: rows are short, and what is left over is added number by number

/// Sums of the numbers 0, 4, 8, ..., of 1, 5, 9, ..., and so on.
struct PartialSums {
  double re[stride]{}, im[stride]{};

  [[gnu::always_inline]] void add_product(std::size_t lane, ColumnView a, ColumnView b, std::size_t i) {
    re[lane] += a.re[i] * b.re[i] - a.im[i] * b.im[i];
    im[lane] += a.re[i] * b.im[i] + a.im[i] * b.re[i];
  }
  Complex total() const { return {(re[0] + re[2]) + (re[1] + re[3]), (im[0] + im[2]) + (im[1] + im[3])}; }
};

/// Calls add(lane, i) for every number, whole strides in loops of fixed length.
template <class Add>
[[gnu::always_inline]] inline void for_each(std::size_t count, Add add) {
  std::size_t first = 0;
  for (; first + stride <= count; first += stride)
    for (std::size_t lane = 0; lane < stride; ++lane) add(lane, first + lane);
  for (std::size_t lane = 0; first + lane < count; ++lane) add(lane, first + lane);
}

}  // namespace

void ComplexColumn::make_room(std::size_t size) {
  if (size <= re.size()) return;
  const std::size_t whole_blocks = (size + lanes - 1) / lanes * lanes;
  re.resize(whole_blocks);
  im.resize(whole_blocks);
}

void store(const Complexes& values, ComplexColumn& column, std::size_t first) {
  std::memcpy(column.re.data() + first, values.re.value, sizeof(Reals));
  std::memcpy(column.im.data() + first, values.im.value, sizeof(Reals));
}

Complexes load(const ComplexColumn& column, std::size_t first) {
  Complexes result;
  std::memcpy(result.re.value, column.re.data() + first, sizeof(Reals));
  std::memcpy(result.im.value, column.im.data() + first, sizeof(Reals));
  return result;
}

void add_products(Complexes& sum, const Complexes& a, const Complexes& b) {
  for (std::size_t i = 0; i < lanes; ++i) {
    sum.re[i] += a.re[i] * b.re[i] - a.im[i] * b.im[i];
    sum.im[i] += a.re[i] * b.im[i] + a.im[i] * b.re[i];
  }
}

Complex sum(ColumnView values, std::size_t count) {
  PartialSums sums;
  for_each(count, [&](std::size_t lane, std::size_t i) {
    sums.re[lane] += values.re[i];
    sums.im[lane] += values.im[i];
  });
  return sums.total();
}

Complex sum_of_products(ColumnView a, ColumnView b, std::size_t count) {
  PartialSums sums;
  for_each(count, [&](std::size_t lane, std::size_t i) { sums.add_product(lane, a, b, i); });
  return sums.total();
}

PairSums sums_of_products(const std::array<ColumnView, 2>& a, const std::array<ColumnView, 2>& b, std::size_t count) {
  PartialSums first, second, third, fourth;
  for_each(count, [&](std::size_t lane, std::size_t i) {
    first.add_product(lane, a[0], b[0], i);
    second.add_product(lane, a[0], b[1], i);
    third.add_product(lane, a[1], b[0], i);
    fourth.add_product(lane, a[1], b[1], i);
  });
  return {{{first.total(), second.total()}, {third.total(), fourth.total()}}};
}

void scale(ColumnView a, Complex factor, std::size_t count, ComplexColumn& to, std::size_t first) {
  for (std::size_t i = 0; i < count; ++i) to.set(first + i, factor * Complex(a.re[i], a.im[i]));
}

void multiply(ColumnView a, ColumnView b, std::size_t count, ComplexColumn& to, std::size_t first) {
  for (std::size_t i = 0; i < count; ++i) to.set(first + i, Complex(a.re[i], a.im[i]) * Complex(b.re[i], b.im[i]));
}

void multiply_by_sum(ColumnView a, ScaledColumn b, ScaledColumn c, std::size_t count, ComplexColumn& to, std::size_t first) {
  double* const re = to.re.data() + first;
  double* const im = to.im.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const double sum_re = b.factor * b.column.re[i] + c.factor * c.column.re[i];
    const double sum_im = b.factor * b.column.im[i] + c.factor * c.column.im[i];
    re[i] = a.re[i] * sum_re - a.im[i] * sum_im;
    im[i] = a.re[i] * sum_im + a.im[i] * sum_re;
  }
}

}  // namespace raytube
