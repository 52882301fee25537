#include "utd/interaction/pair_reach.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace raytube {

namespace {

constexpr int bisections = 50;

// Pairs whose product is no less than a limit: how many, and the sum of their squares.
struct Above {
  double pairs = 0.0, squares = 0.0;
};

// Both lists from the largest on; `area_squares`[j]: sum over the first j areas.
Above above(double limit, const std::vector<double>& lengths, const std::vector<double>& areas,
            const std::vector<double>& area_squares) {
  Above sum;
  std::size_t count = areas.size();
  for (const double length : lengths) {
    while (count > 0 && length * areas[count - 1] < limit) --count;
    sum.pairs += static_cast<double>(count);
    sum.squares += length * length * area_squares[count];
  }
  return sum;
}

double sum_of_squares(const std::vector<double>& values) {
  return std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
}

}  // namespace

PairReach::PairReach(std::vector<double> lengths, std::vector<double> areas) {
  if (lengths.empty() || areas.empty()) return;
  std::ranges::sort(lengths, std::greater{});
  std::ranges::sort(areas, std::greater{});
  std::vector<double> area_squares{0.0};
  for (const double area : areas) area_squares.push_back(area_squares.back() + area * area);
  const double all = sum_of_squares(lengths) * area_squares.back();
  all_ = static_cast<double>(lengths.size()) * static_cast<double>(areas.size());
  for (double pairs = 1.0; pairs < all_; pairs *= 2.0) {
    double low = 0.0, high = 2.0 * lengths.front() * areas.front();  // no pair is as strong as that
    for (int i = 0; i < bisections; ++i) {
      const double limit = 0.5 * (low + high);
      (above(limit, lengths, areas, area_squares).pairs > pairs ? low : high) = limit;
    }
    const Above strongest = above(high, lengths, areas, area_squares), next = above(low, lengths, areas, area_squares);
    // Many may be as strong as one another.
    const double part = next.pairs > strongest.pairs ? (pairs - strongest.pairs) / (next.pairs - strongest.pairs) : 0.0;
    shares_.push_back((strongest.squares + std::clamp(part, 0.0, 1.0) * (next.squares - strongest.squares)) / all);
  }
}

double PairReach::of(double pairs) const {
  if (pairs >= all_) return 1.0;
  if (pairs < 1.0) return 0.0;
  const double place = std::log2(pairs);
  const auto below = static_cast<std::size_t>(place);
  const double next = below + 1 < shares_.size() ? shares_[below + 1] : 1.0;
  return shares_[below] + (place - static_cast<double>(below)) * (next - shares_[below]);
}

}  // namespace raytube
