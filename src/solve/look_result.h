// What one look gives, and the same as bytes, to be kept and taken up again.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "plan/plan.h"
#include "sbr/beams/tube_sums.h"
#include "scene/contribution.h"

namespace raytube {

/// One look, all frequencies: what the tubes and the other mechanisms give, kept apart.
struct LookResult {
  TubeSums tubes;
  std::vector<Contribution> mechanisms{};  // beside them, in the order of the plan
  std::vector<std::vector<double>> met{};  // [band] TubeSums::met
  std::vector<double> truncated{};         // [band] area times squared amplitude of truncated tubes [m^2]

  /// Lets go of what the estimate of the tubes' error was made from, which is most of it at many frequencies.
  void keep_sums_only();
};

/// Takes in the look as it is at the frequencies of one band, of so many in all.
void put_band(const BandPlan& band, LookResult part, std::size_t frequencies, LookResult& all);

/// Exactly what the rows and the counts of a sweep need, every double with all its bits. Of the same program only.
std::string look_bytes(const LookResult& look);

/// The look again, or none if the bytes are not those of one at so many frequencies, with so many mechanisms.
std::optional<LookResult> look_of_bytes(std::string_view bytes, std::size_t frequencies, std::size_t mechanisms);

}  // namespace raytube
