#include "sbr/refinement.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// The share of the permitted square that blocks may leave which are not refined, and the share of the permitted error that the
// others aim at: a grid denser by a third costs less than one more that only just misses.
constexpr double left_alone = 0.25, aim = 0.65;
// The least and the most by which cells per wavelength grow.
constexpr double least_growth = 1.5, most_growth = 4.0;

double square(const BlockError& error) { return error.excess * error.excess; }

}  // namespace

Refinement refinement(const std::vector<BlockError>& errors, double whole, double order) {
  std::vector<std::size_t> rising;
  double all = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    all += square(errors[i]);
    if (errors[i].refinable && errors[i].excess > 0.0) rising.push_back(i);
  }
  std::ranges::stable_sort(rising, {}, [&](std::size_t i) { return errors[i].excess; });
  const double scale = std::max(1.0, whole * whole / all);
  double left = 0.0, refined = 0.0;
  auto first = rising.begin();
  for (; first != rising.end() && left + scale * square(errors[*first]) <= left_alone; ++first)
    left += scale * square(errors[*first]);
  for (auto i = first; i != rising.end(); ++i) refined += scale * square(errors[*i]);
  Refinement result{{first, rising.end()}, 1.0};
  std::ranges::sort(result.blocks);
  if (!result.blocks.empty())
    result.growth = std::clamp(std::pow(std::sqrt(refined / (1.0 - left)) / aim, 1.0 / order), least_growth, most_growth);
  return result;
}

}  // namespace raytube
