// Pulses that are not traced: what bodies add to S between those that are.
//
// S is a sum over places of the target of e^{-jkL}, L the path over one place, or from one to others, times amplitudes that
// change slowly. Where places are at any time is known from the motion of the parts they are on. So a sample of such phasors, of
// places all over the boxes of the parts, spans what S may be at the pulses of an interval, to a small share; and a basis of it,
// of some functions more than there are Doppler cells in the band of the target (Landau and Pollak 1962, Bell System Technical
// Journal 41, 1295), tells S at all pulses from as many of them. How many have to be traced hangs on the case alone, so that no
// row hangs on threads, ranks or shards; what is found between is that of least squares. What changes otherwise, shadows and
// glints, is not in the sample: some more times are traced to see how far off it is.
#pragma once

#include "case/moving_target.h"
#include "scene/results.h"

namespace raytube {

/// Neighbouring pulses, by number [begin, end), with those that are traced among them.
struct TracedInterval {
  std::size_t begin, end;
  std::vector<std::size_t> fitted;   // ascending; all of them: nothing is left to find between
  std::vector<std::size_t> checked;  // traced as well, to compare with
  std::vector<Complex> from_fitted;  // [fitted][other] what S adds to that at pulses which are not, but for mean phasors
};

/// Of a case with motion.retrace = "auto".
std::vector<TracedInterval> traced_intervals(const Case& c, const MovingTarget& target);

/// The case at the times that are traced alone.
Case traced_case(const Case& c, const std::vector<TracedInterval>& intervals);

/// The same for any case that moves: all of its times, unless motion.retrace = "auto".
Case computed_case(const Case& c, const MovingTarget& target);

/// All rows of the case, from those of the traced times. Where there are both, what was computed stays; the others are told in
/// `skipped`, with how far off the checked times would have been; their errors grow by what holds of most of them.
SweepResult with_all_times(const Case& c, const MovingTarget& target, const std::vector<TracedInterval>& intervals,
                           SweepResult traced);

}  // namespace raytube
