#include "utd/columns.h"

#include <algorithm>

namespace raytube {

namespace {

Complex sum(const Complexes& values) {
  Complex total = 0.0;
  for (std::size_t i = 0; i < lanes; ++i) total += values[i];
  return total;
}

}  // namespace

void ComplexColumn::resize(std::size_t size) {
  const std::size_t whole_blocks = (size + lanes - 1) / lanes * lanes;
  re.resize(whole_blocks);
  im.resize(whole_blocks);
}

void store(const Complexes& values, ComplexColumn& column, std::size_t first) {
  std::copy_n(values.re.value, lanes, column.re.data() + first);
  std::copy_n(values.im.value, lanes, column.im.data() + first);
}

void add_products(Complexes& sum, const Complexes& a, const Complexes& b) {
  for (std::size_t i = 0; i < lanes; ++i) {
    sum.re[i] += a.re[i] * b.re[i] - a.im[i] * b.im[i];
    sum.im[i] += a.re[i] * b.im[i] + a.im[i] * b.re[i];
  }
}

Complex sum(ColumnPlace values, std::size_t count) {
  Complexes sums{};
  std::size_t first = 0;
  const auto add = [&](std::size_t width) {
    for (std::size_t i = 0; i < width; ++i) {
      sums.re[i] += values.re[first + i];
      sums.im[i] += values.im[first + i];
    }
  };
  for (; first + lanes <= count; first += lanes) add(lanes);
  add(count - first);
  return sum(sums);
}

Complex sum_of_products(ColumnPlace a, ColumnPlace b, std::size_t count) {
  Complexes sums{};
  std::size_t first = 0;
  const auto add = [&](std::size_t width) {
    for (std::size_t i = 0, j = first; i < width; ++i, ++j) {
      sums.re[i] += a.re[j] * b.re[j] - a.im[j] * b.im[j];
      sums.im[i] += a.re[j] * b.im[j] + a.im[j] * b.re[j];
    }
  };
  for (; first + lanes <= count; first += lanes) add(lanes);
  add(count - first);
  return sum(sums);
}

void scale(ColumnPlace a, Complex factor, std::size_t count, ComplexColumn& to, std::size_t first) {
  for (std::size_t i = 0; i < count; ++i) to.set(first + i, factor * Complex(a.re[i], a.im[i]));
}

void multiply(ColumnPlace a, ColumnPlace b, std::size_t count, ComplexColumn& to, std::size_t first) {
  for (std::size_t i = 0; i < count; ++i) to.set(first + i, Complex(a.re[i], a.im[i]) * Complex(b.re[i], b.im[i]));
}

}  // namespace raytube
