#include "output/products/profile_netcdf.h"

#include <array>

#include "output/netcdf/new_netcdf.h"
#include "output/products/amplitude_variables.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

std::string of_looks(const StoredResult& result) {
  return std::string("theta_deg phi_deg rx_theta_deg rx_phi_deg") + (result.moving ? " time_s" : "");
}

void write_head(NewNetcdf& out, const StoredResult& result, const RangeProfiles& profiles, const Window& window) {
  describe_product(out, result, window);
  out.attribute("peak_dbsm", std::array{sigma_dbsm(profiles.peak.amplitude)});
  out.attribute("peak_range_m", std::array{profiles.peak.range});
  out.attribute("peak_look", std::array{static_cast<double>(profiles.peak.look)});
  out.attribute("range_resolution_m", std::array{profiles.limits.resolution});
  out.attribute("range_unambiguous_m", std::array{profiles.limits.unambiguous});
  out.attribute("range_direction",
                "away from the radar along the line of sight, from the origin of the mesh's coordinates; of a bistatic look half "
                "of the additional path");
}

void write_axes(NewNetcdf& out, const StoredResult& result, const EvenAxis& range) {
  out.dimension("look", result.looks.size());
  out.dimension("range_m", range.count);
  out.polarisations();
  out.looks(result.looks);
  if (result.moving) out.times(result.looks);
  std::vector<double> at;
  for (std::size_t i = 0; i < range.count; ++i) at.push_back(range.at(i));
  out.put(out.variable("range_m", {"range_m"}, "m", "range"), at);
}

void write_floor(NewNetcdf& out, const StoredResult& result, const char* name, const char* long_name,
                 const std::vector<ChannelErrors>& errors) {
  const int variable = out.variable(name, {"look", "receive", "transmit"}, "dBsm", long_name);
  out.attribute(variable, "coordinates", of_looks(result));
  std::vector<double> levels = flat(errors);
  for (double& each : levels) each = sigma_dbsm(each);
  out.put(variable, levels);
}

}  // namespace

void write_profile_netcdf(const std::filesystem::path& file, const StoredResult& result, const RangeProfiles& profiles,
                          const Window& window) {
  NewNetcdf out(file);
  write_head(out, result, profiles, window);
  write_axes(out, result, profiles.range);
  write_amplitudes(out, {"look", "range_m"}, "range profile p", of_looks(result), profiles.s);
  write_floor(out, result, "error_dbsm", "numerical error if all of it were at one range", profiles.error);
  write_floor(out, result, "model_dbsm", "model uncertainty if all of it were at one range", profiles.model);
  out.write();
}

}  // namespace raytube
