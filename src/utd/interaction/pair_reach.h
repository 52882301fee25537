// How far work reaches among pairs of edge and face, the strongest first, before any of them is looked at; and how many of the
// strongest candidates a budget pays for, without regard to their order in a list.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace raytube {

/// What is expected of a pair is taken to go with length times area, as its bound does (docs/theory/interaction.md).
class PairReach {
 public:
  PairReach() = default;
  /// Lengths of the edges [m] and areas of the faces [m^2], in any order.
  PairReach(std::vector<double> lengths, std::vector<double> areas);

  /// The share of the sum of squares over all pairs that so many of the strongest have.
  double of(double pairs) const;

 private:
  std::vector<double> shares_;  // of 2^i pairs
  double all_ = 0.0;            // pairs
};

/// Candidates whose sizes differ by less than this share count as equally strong: equal ones of a body that is turned, or whose
/// triangles come in another order, differ by rounding, and by that of files of few digits.
inline constexpr double equally_strong = 2e-5;

/// How many of the first of `descending` sizes count if `wanted` may: of equally strong ones all or none, all if these are not
/// more than twice as many as wanted; the strongest `in_any_case` or as the others.
inline std::size_t with_equals(std::span<const double> descending, double wanted, bool in_any_case = true) {
  if (!(wanted < static_cast<double>(descending.size()))) return descending.size();
  if (wanted < 1.0 && !in_any_case) return 0;
  const auto last = static_cast<std::size_t>(wanted < 1.0 ? 1.0 : wanted) - 1;
  const auto equal = [&](double a, double b) { return std::abs(a - b) <= equally_strong * std::max(a, b); };
  std::size_t begin = last, end = last + 1;
  while (begin > 0 && equal(descending[begin - 1], descending[begin])) --begin;
  while (end < descending.size() && equal(descending[end], descending[end - 1])) ++end;
  return (begin == 0 && in_any_case) || static_cast<double>(end) <= 2.0 * wanted ? end : begin;
}

}  // namespace raytube
