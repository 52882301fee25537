// Pulses that are not traced: what bodies add to S between those that are.
//
// Within an interval S is modelled as  S(t) = sum over g of A_g(t) e^{-j k L_g(t)},  L_g the path over the middle of what moves
// as one, or the mean of two such paths for what gets from one to the other, A_g a polynomial. All of what moves as one turns the
// phase of A_g by no more than k (L_i - L_g) for points i of its box, known from its motion: with the largest slope of this over
// the interval, half of it long, z, Chebyshev's coefficients of A_g fall as the Bessel functions J_n(z) (Jacobi and Anger;
// Abramowitz and Stegun 9.1.42 to 9.1.45). That fixes how many times have to be traced, by the case alone, so that no row hangs
// on threads, ranks or shards; coefficients are those of least squares. What changes otherwise, shadows and glints, is not in
// this bound: some more times are traced to see how far off it is.
#pragma once

#include "case/moving_target.h"
#include "scene/results.h"

namespace raytube {

/// Neighbouring pulses, by number [begin, end), with those that are traced among them.
struct TracedInterval {
  std::size_t begin, end;
  std::vector<std::size_t> fitted;   // ascending; all of them: nothing is left to find between
  std::vector<std::size_t> checked;  // traced as well, to compare with
};

/// Of a case with motion.retrace = "auto".
std::vector<TracedInterval> traced_intervals(const Case& c, const MovingTarget& target);

/// The case at the times that are traced alone.
Case traced_case(const Case& c, const std::vector<TracedInterval>& intervals);

/// The same for any case that moves: all of its times, unless motion.retrace = "auto".
Case computed_case(const Case& c, const MovingTarget& target);

/// All rows of the case, from those of the traced times. Where there are both, what was computed stays; the others are told in
/// `skipped`, with how far off the checked times would have been; by as much their errors grow.
SweepResult with_all_times(const Case& c, const MovingTarget& target, const std::vector<TracedInterval>& intervals,
                           SweepResult traced);

}  // namespace raytube
