#include "output/products/amplitude_variables.h"

#include <algorithm>
#include <functional>
#include <ranges>

#include "output/tables/csv.h"

namespace raytube {

void describe_product(NewNetcdf& out, const StoredResult& result, const Window& window) {
  out.describe(result);
  out.attribute("window", description_of(window));
  const auto span = [&](const char* name, const auto& values, auto member) {
    const auto [low, high] = std::ranges::minmax(values | std::views::transform(member));
    out.attribute(name, std::array{low, high});
  };
  span("frequency_span_hz", result.frequency_hz, std::identity{});
  span("theta_span_deg", result.looks, &StoredLook::theta_deg);
  span("phi_span_deg", result.looks, &StoredLook::phi_deg);
}

void write_outline(NewNetcdf& out, const std::vector<std::array<dvec3, 2>>& lines) {
  if (lines.empty()) return;
  std::vector<double> places;
  for (const auto& ends : lines)
    for (const dvec3& end : ends) places.insert(places.end(), {end.x, end.y, end.z});
  out.dimension("edge", lines.size());
  out.dimension("end", 2);
  out.put(out.variable("outline", {"edge", "end", "xyz"}, "m", "edges of the target"), places);
}

void write_amplitudes(NewNetcdf& out, std::vector<std::string> axes, const std::string& what, const std::string& coordinates,
                      const std::vector<ScatteringMatrix>& s) {
  axes.insert(axes.end(), {"receive", "transmit"});
  const auto write = [&](const char* name, const char* units, const std::string& long_name, const std::vector<double>& values) {
    const int variable = out.variable(name, axes, units, long_name);
    out.attribute(variable, "coordinates", coordinates);
    out.put(variable, values);
  };
  std::vector<double> levels;
  levels.reserve(4 * s.size());
  for (const ScatteringMatrix& each : s)
    for (const int channel : {0, 1, 2, 3}) levels.push_back(sigma_dbsm(each.at(channel / 2, channel % 2)));
  write("S_re", "m", "real part of the " + what, components(s, ComplexPart::real));
  write("S_im", "m", "imaginary part of the " + what, components(s, ComplexPart::imaginary));
  write("sigma_dbsm", "dBsm", "level of the " + what + ", 10 log10(4 pi |S|^2 / 1 m^2): a point of sigma reads sigma", levels);
}

}  // namespace raytube
