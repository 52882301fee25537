#include "output/products/profile_csv.h"

#include <fmt/format.h>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/products/amplitude_columns.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

std::string head(const RangeProfiles& profiles, const Window& window, bool moving) {
  const AxisLimits& limits = profiles.limits;
  std::string text = fmt::format(
      "# Range profiles: p(R) = sum of w S exp(j 2 k R) / sum of w over the frequencies, weights w: {}. range_m: beyond the "
      "origin\n"
      "# of the mesh's coordinates along the line of sight, away from the radar; of a bistatic look half of the additional "
      "path.\n"
      "# A point of sigma reads sigma. Peaks are {:.6g} m wide 3 dB below their top; what is {:.6g} m farther appears at the "
      "same range.\n"
      "# error_pq_dbsm, model_pq_dbsm: 4 pi times the square of the numerical error, of the model uncertainty, if all of it were "
      "at "
      "one range.\n",
      name_of(window), limits.resolution, limits.unambiguous);
  text += "theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,range_m" + amplitude_columns();
  for (const char* level : {"error", "model"})
    for (const char* channel : channel_names) text += fmt::format(",{}_{}_dbsm", level, channel);
  return text + (moving ? ",time_s\n" : "\n");
}

std::string floors_text(const ChannelErrors& errors) {
  std::string text;
  for (const int channel : {0, 1, 2, 3}) text += fmt::format(",{:.2f}", sigma_dbsm(errors[channel / 2][channel % 2]));
  return text;
}

std::string row_text(double range, const ScatteringMatrix& s) { return fmt::format(",{:.9g}", range) + amplitudes_text(s, 9); }

}  // namespace

void write_profile_csv(const std::filesystem::path& file, const StoredResult& result, const RangeProfiles& profiles,
                       const Window& window) {
  OutputFile out(file);
  out.write(head(profiles, window, result.moving));
  for (std::size_t look = 0; look < result.looks.size(); ++look) {
    const StoredLook& at = result.looks[look];
    const std::string keys = fmt::format("{},{},{},{}", number_text(at.theta_deg), number_text(at.phi_deg),
                                         number_text(at.rx_theta_deg), number_text(at.rx_phi_deg)),
                      floors = floors_text(profiles.error[look]) + floors_text(profiles.model[look]),
                      end = result.moving ? ',' + number_text(at.time_s) + '\n' : "\n";
    for (std::size_t i = 0; i < profiles.range.count; ++i)
      out.write(keys + row_text(profiles.range.at(i), profiles.s[look * profiles.range.count + i]) + floors + end);
  }
  out.commit();
}

}  // namespace raytube
