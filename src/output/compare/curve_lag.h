// How far one curve is shifted against another.
#pragma once

#include <vector>

namespace raytube {

/// Two curves over the same x, which does not fall.
struct CurvePair {
  std::vector<double> x, a, b;
};

/// The shift d for which a(x) correlates best with b(x - d) over all pairs together, in units of x: positive when the features of
/// a lie at larger x. b is taken linearly between its points. Shifts are whole multiples of the median step, up to a quarter of
/// the longest curve and 200 steps; a parabola through the best one and its neighbours gives the fraction. NaN if the curves have
/// fewer than five points, correlate by less than 0.5 at any shift, or correlate best at the end of that range.
double best_lag(const std::vector<CurvePair>& pairs);

}  // namespace raytube
