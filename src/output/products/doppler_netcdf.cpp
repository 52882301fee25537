#include "output/products/doppler_netcdf.h"

#include <array>
#include <cmath>

#include "output/netcdf/new_netcdf.h"
#include "output/products/amplitude_variables.h"
#include "output/tables/csv.h"
#include "output/tables/stored.h"

namespace raytube {

namespace {

std::vector<double> values_of(const EvenAxis& axis) {
  std::vector<double> values;
  for (std::size_t i = 0; i < axis.count; ++i) values.push_back(axis.at(i) + 0.0);
  return values;
}

void write_axis(NewNetcdf& out, const char* name, const char* units, const char* long_name, const EvenAxis& axis) {
  out.dimension(name, axis.count);
  out.put(out.variable(name, {name}, units, long_name), values_of(axis));
}

void write_looks(NewNetcdf& out, const std::vector<std::size_t>& looks) {
  out.dimension("look", looks.size());
  out.put(out.variable("look", {"look"}, "1", "look of a pulse"), {looks.begin(), looks.end()});
}

// Velocities, and the Doppler frequencies that they are.
template <class Product>
void write_velocities(NewNetcdf& out, const Product& product) {
  out.attribute("doppler_frequency_hz", std::array{product.frequency});
  out.attribute("velocity_resolution_m_per_s", std::array{product.velocity_limits.resolution});
  out.attribute("velocity_unambiguous_m_per_s", std::array{product.velocity_limits.unambiguous});
  write_axis(out, "velocity_m_per_s", "m s-1", "velocity towards the radar", product.velocity);
  std::vector<double> doppler = values_of(product.velocity);
  for (double& each : doppler) each = product.doppler_of(each);
  out.put(out.variable("doppler_hz", {"velocity_m_per_s"}, "Hz", "Doppler frequency, 2 v / lambda at doppler_frequency_hz"),
          doppler);
}

// Places of antennas, or directions to them, of every look [look][xyz].
std::vector<double> antennas(const std::vector<Look>& looks, Direction Look::*direction, double Look::*range) {
  std::vector<double> values;
  for (const Look& look : looks) {
    const dvec3 at = (look.far() ? 1.0 : look.*range) * spherical_basis(look.*direction).radial;
    values.insert(values.end(), {at.x + 0.0, at.y + 0.0, at.z + 0.0});
  }
  return values;
}

// [pulse][frequency][receiver] of rows [pulse][receiver][frequency].
std::vector<ScatteringMatrix> cube_of(const StoredResult& result, std::size_t receivers) {
  std::vector<ScatteringMatrix> cube;
  cube.reserve(result.s.size());
  const std::size_t frequencies = result.frequency_hz.size();
  for (std::size_t first = 0; first < result.looks.size(); first += receivers)
    for (std::size_t f = 0; f < frequencies; ++f)
      for (std::size_t receiver = 0; receiver < receivers; ++receiver)
        cube.push_back(result.s[(first + receiver) * frequencies + f]);
  return cube;
}

}  // namespace

void write_doppler_netcdf(const std::filesystem::path& file, const StoredResult& result, const DopplerMap& map,
                          const Window& window) {
  NewNetcdf out(file);
  describe_product(out, result, window);
  out.attribute("peak_dbsm", std::array{sigma_dbsm(map.peak.amplitude)});
  out.attribute("peak_velocity_m_per_s", std::array{map.peak.velocity});
  out.attribute("peak_look", std::array{static_cast<double>(map.peak.look)});
  out.attribute("time_s", std::array{map.time.middle()});
  write_looks(out, map.looks);
  std::vector<std::string> axes{"look"};
  if (map.range_limits) {
    out.attribute("peak_range_m", std::array{map.peak.range});
    out.attribute("range_resolution_m", std::array{map.range_limits->resolution});
    out.attribute("range_unambiguous_m", std::array{map.range_limits->unambiguous});
    write_axis(out, "range_m", "m", "range", map.range);
    axes.emplace_back("range_m");
  }
  write_velocities(out, map);
  axes.emplace_back("velocity_m_per_s");
  if (map.cosine_limits) {
    out.attribute("peak_cosine", std::array{map.peak.cosine});
    out.attribute("cosine_resolution", std::array{map.cosine_limits->resolution});
    out.attribute("cosine_unambiguous", std::array{map.cosine_limits->unambiguous});
    out.attribute("array_direction", std::array{map.array.x + 0.0, map.array.y + 0.0, map.array.z + 0.0});
    write_axis(out, "cosine", "1", "cosine between the direction from the array and that along it", map.cosine);
    axes.emplace_back("cosine");
  }
  out.polarisations();
  write_amplitudes(out, axes, "range-Doppler map M", "doppler_hz", map.s);
  out.write();
}

void write_spectrogram_netcdf(const std::filesystem::path& file, const StoredResult& result, const Spectrogram& spectrogram,
                              const Window& window) {
  NewNetcdf out(file);
  describe_product(out, result, window);
  out.attribute("window_pulses", std::array{static_cast<double>(spectrogram.length)});
  write_looks(out, spectrogram.looks);
  write_axis(out, "time_s", "s", "middle of the pulses of a window", spectrogram.time);
  write_velocities(out, spectrogram);
  out.polarisations();
  const int variable = out.variable("sigma_dbsm", {"look", "time_s", "velocity_m_per_s", "receive", "transmit"}, "dBsm",
                                    "level of the spectrogram: a point of sigma reads sigma");
  out.attribute(variable, "coordinates", "doppler_hz");
  std::vector<double> levels = flat(spectrogram.sigma);
  for (double& each : levels) each = 10.0 * std::log10(each);
  out.put(variable, levels);
  out.write();
}

void write_raw_netcdf(const std::filesystem::path& file, const StoredResult& result, const std::string& what) {
  const Sweep sweep = sweep_of(result);
  const PulseGrid pulses = pulse_grid(sweep.times, what);
  NewNetcdf out(file);
  out.describe(result);
  out.dimension("pulse", pulses.times.size());
  out.dimension("frequency", result.frequency_hz.size());
  out.dimension("receiver", pulses.looks);
  out.polarisations();
  out.labels("xyz", {"x", "y", "z"}, "axis of the mesh's coordinates");
  out.put(out.variable("time_s", {"pulse"}, "s", "time of the pulse"), pulses.times);
  out.put(out.variable("frequency", {"frequency"}, "Hz", "frequency"), result.frequency_hz);
  const bool far = result.far();
  const char *const ending = far ? "_direction" : "_m", *const units = far ? "1" : "m",
                    *const long_name = far ? "unit vector towards the " : "place of the ";
  const auto put_antennas = [&](const std::string& name, Direction Look::*direction, double Look::*range) {
    out.put(out.variable(name + ending, {"pulse", "receiver", "xyz"}, units, long_name + name),
            antennas(sweep.looks, direction, range));
  };
  put_antennas("transmitter", &Look::transmit, &Look::transmit_range);
  put_antennas("receiver", &Look::receive, &Look::receive_range);
  const std::vector<ScatteringMatrix> cube = cube_of(result, pulses.looks);
  const auto put_cube = [&](const char* name, const char* text, ComplexPart part) {
    out.put(out.variable(name, {"pulse", "frequency", "receiver", "receive", "transmit"}, "m", text), components(cube, part));
  };
  put_cube("S_re", "real part of the scattering amplitude S", ComplexPart::real);
  put_cube("S_im", "imaginary part of the scattering amplitude S", ComplexPart::imaginary);
  out.write();
}

}  // namespace raytube
