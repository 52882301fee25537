#include "output/tables/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/decimal.h"
#include "output/files/files.h"
#include "scene/bounce_names.h"

namespace raytube {

namespace {

constexpr const char* wave_conventions =
    "# Time factor exp(+j omega t); a wave travels as exp(-j k r). Phase reference: the origin of the mesh's coordinates.\n"
    "# Scattering amplitude S_pq [m], p receive, q transmit: E_p(scattered) = S_pq E_q(incident) exp(-j k r) / r.\n"
    "# sigma_pq = 4 pi |S_pq|^2; dBsm is 10 log10(sigma / 1 m^2). vh is receive V, transmit H.\n"
    "# err_pq_db = 20 log10(1 + error / max(|S_pq|, S_max / 100)): estimated numerical error of |S_pq|; S_max is the row's "
    "largest.\n"
    "# model_pq_db: the same of model uncertainty, the estimate of what asymptotic physics leaves out in |S_pq|.\n"
    "# Directions point from the target: theta from +z, phi from +x towards +y; theta_deg, phi_deg to the "
    "transmitter, rx_ to the receiver.\n"
    "# V is theta-hat and H is phi-hat of each one's own direction, for the transmitter and for the receiver.\n";

std::string antenna_note(bool far) {
  if (far) return {};
  return "# Antennas at a finite distance: S is the apparent amplitude, that of something at the origin that would make the same "
         "signal.\n"
         "# range_m: from the origin of the mesh's coordinates to the transmitter, rx_range_m to the receiver. Off their lines "
         "to the "
         "origin V and H are turned with the ray (Ludwig's third definition).\n";
}

std::string range_note(const SweepResult& result) {
  if (!(result.statistics.ray_range > 0.0)) return {};
  return fmt::format("# edges.method = \"utd\": S is the apparent amplitude for transmitter and receiver {} m from the origin.\n",
                     number_text(result.statistics.ray_range));
}

std::array<Complex, 4> channels(const ScatteringMatrix& s) { return {s.vv(), s.vh(), s.hv(), s.hh()}; }

std::string direction_text(const Direction& direction) {
  return number_text(decimal_degrees(direction.theta)) + ',' + number_text(decimal_degrees(direction.phi));
}

std::string complex_text(Complex value) { return number_text(value.real()) + ',' + number_text(value.imag()); }

const char* time_column(bool moving) { return moving ? ",time_s" : ""; }

// Calls visit(row, frequency text, look, end of its lines) for every row in the order of the files.
template <typename Visit>
void for_each_row(const Sweep& sweep, Visit visit) {
  for (std::size_t i = 0; i < sweep.looks.size(); ++i)
    for (std::size_t k = 0; k < sweep.frequencies.size(); ++k)
      visit(sweep.row(i, k), number_text(sweep.frequencies[k]), sweep.looks[i],
            (sweep.times.empty() ? "" : ',' + number_text(sweep.times[i])) + '\n');
}

std::string complex_columns(const std::string& suffix) {
  std::string names;
  for (const char* channel : channel_names) names += fmt::format(",re_{0}{1},im_{0}{1}", channel, suffix);
  return names;
}

std::string complex_values(const ScatteringMatrix& s) {
  std::string text;
  for (const Complex value : channels(s)) text += ',' + complex_text(value);
  return text;
}

std::string error_values(const ChannelErrors& errors) {
  std::string text;
  for (const std::array<double, 2>& receive : errors)
    for (const double value : receive) text += ',' + number_text(value);
  return text;
}

ChannelErrors by_channel(const std::array<double, 4>& values) { return {{{values[0], values[1]}, {values[2], values[3]}}}; }

ChannelErrors sigmas_dbsm(const ScatteringMatrix& s) {
  return {{{sigma_dbsm(s.vv()), sigma_dbsm(s.vh())}, {sigma_dbsm(s.hv()), sigma_dbsm(s.hh())}}};
}

std::string rcs_row(const std::string& frequency, const StoredLook& look, bool moving, const ScatteringMatrix& s,
                    const RcsLevels& levels) {
  std::string line = frequency;
  for (const double angle : {look.theta_deg, look.phi_deg, look.rx_theta_deg, look.rx_phi_deg}) line += ',' + number_text(angle);
  line += complex_values(s) + error_values(levels.sigma_dbsm) + error_values(levels.err_db) + error_values(levels.model_db);
  if (!look.far()) line += ',' + number_text(look.range_m) + ',' + number_text(look.rx_range_m);
  if (moving) line += ',' + number_text(look.time_s);
  return line + '\n';
}

std::string polar_text(Complex value) {
  const double magnitude = std::sqrt(4.0 * pi) * std::hypot(value.real(), value.imag());
  const double phase = std::atan2(value.imag() + 0.0, value.real() + 0.0);  // + 0.0: a negative zero must not turn pi into -pi
  return number_text(magnitude) + ',' + number_text(phase);
}

}  // namespace

std::string conventions(const SweepResult& result) { return wave_conventions + range_note(result); }

std::string key_text(const std::string& frequency, const Look& look) {
  return frequency + ',' + direction_text(look.transmit) + ',' + direction_text(look.receive);
}

double sigma_dbsm(Complex s) { return 20.0 * std::log10(std::hypot(s.real(), s.imag())) + 10.0 * std::log10(4.0 * pi); }

std::string vector_text(const dvec3& vector) {
  return fmt::format("({}, {}, {})", number_text(vector.x + 0.0), number_text(vector.y + 0.0), number_text(vector.z + 0.0));
}

std::array<double, 4> error_levels_db(const ScatteringMatrix& s, const ChannelErrors& errors) {
  const std::array<Complex, 4> values = channels(s);
  const std::array<double, 4> error{errors[0][0], errors[0][1], errors[1][0], errors[1][1]};
  std::array<double, 4> levels{};
  for (std::size_t i = 0; i < levels.size(); ++i)
    if (error[i] > 0.0)
      levels[i] = 20.0 / std::log(10.0) * std::log1p(error[i] / std::max(std::abs(values[i]), 0.01 * largest_amplitude(s)));
  return levels;
}

std::string rcs_comment(const Sweep& sweep, const SweepResult& result, const std::string& note) {
  return conventions(result) + antenna_note(sweep.looks.front().far()) + note;
}

std::string rcs_columns(bool far, bool moving) {
  std::string header = key_columns + complex_columns("");
  for (const char* channel : channel_names) header += fmt::format(",sigma_{}_dbsm", channel);
  for (const char* channel : channel_names) header += fmt::format(",err_{}_db", channel);
  for (const char* channel : channel_names) header += fmt::format(",model_{}_db", channel);
  return header + (far ? "" : ",range_m,rx_range_m") + time_column(moving);
}

StoredLook stored_look(const Sweep& sweep, std::size_t i) {
  const Look& look = sweep.looks[i];
  return {decimal_degrees(look.transmit.theta),
          decimal_degrees(look.transmit.phi),
          decimal_degrees(look.receive.theta),
          decimal_degrees(look.receive.phi),
          look.transmit_range,
          look.receive_range,
          sweep.times.empty() ? 0.0 : sweep.times[i]};
}

RcsLevels rcs_levels(const SweepResult& result, std::size_t row) {
  const ScatteringMatrix& s = result.total[row];
  return {sigmas_dbsm(s), by_channel(error_levels_db(s, result.error[row])), by_channel(error_levels_db(s, result.model[row]))};
}

void write_rcs_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result, const std::string& note) {
  OutputFile out(file);
  out.write(rcs_comment(sweep, result, note) + rcs_columns(sweep.looks.front().far(), !sweep.times.empty()) + '\n');
  for_each_row(sweep, [&](std::size_t row, const std::string& frequency, const Look&, const std::string&) {
    out.write(rcs_row(frequency, stored_look(sweep, row / sweep.frequencies.size()), !sweep.times.empty(), result.total[row],
                      rcs_levels(result, row)));
  });
  out.commit();
}

void write_rcs_csv(const std::filesystem::path& file, const StoredResult& result) {
  OutputFile out(file);
  out.write(result.comment + rcs_columns(result.far(), result.moving) + '\n');
  for (std::size_t row = 0; row < result.rows(); ++row) {
    const std::size_t frequencies = result.frequency_hz.size();
    out.write(rcs_row(number_text(result.frequency_hz[row % frequencies]), result.looks[row / frequencies], result.moving,
                      result.s[row], {result.sigma_dbsm[row], result.err_db[row], result.model_db[row]}));
  }
  out.commit();
}

void write_channels_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result) {
  OutputFile out(file);
  out.write("freq_hz,theta_deg,phi_deg,tx_pol,v_magnitude,v_phase_rad,h_magnitude,h_phase_rad");
  out.write(std::string(sweep.bistatic ? ",rx_theta_deg,rx_phi_deg" : "") + time_column(!sweep.times.empty()) + '\n');
  for_each_row(sweep, [&](std::size_t row, const std::string& frequency, const Look& look, const std::string& end) {
    const ScatteringMatrix& s = result.total[row];
    for (const int transmit : {0, 1}) {
      std::string line = frequency + ',' + direction_text(look.transmit) + (transmit == 0 ? ",v," : ",h,") +
                         polar_text(s.at(0, transmit)) + ',' + polar_text(s.at(1, transmit));
      if (sweep.bistatic) line += ',' + direction_text(look.receive);
      out.write(line + end);
    }
  });
  out.commit();
}

void write_incoherent_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result) {
  OutputFile out(file);
  out.write(
      "# Power that roughness takes from reflected waves, scattered by Lambert's law: to be added to sigma as power, without a\n"
      "# phase. By transmit polarisation, both receive polarisations together; sigma in dBsm, 10 log10(sigma / 1 m^2).\n");
  out.write(std::string(key_columns) + ",sigma_incoherent_v_dbsm,sigma_incoherent_h_dbsm" + time_column(!sweep.times.empty()) +
            '\n');
  for_each_row(sweep, [&](std::size_t row, const std::string& frequency, const Look& look, const std::string& end) {
    std::string line = key_text(frequency, look);
    for (const double sigma : result.incoherent[row]) line += ',' + number_text(10.0 * std::log10(sigma));
    out.write(line + end);
  });
  out.commit();
}

void write_power_csv(const std::filesystem::path& file, const Sweep& sweep, const LinkBudget& link, const SweepResult& result) {
  OutputFile out(file);
  out.write(
      fmt::format("# Received power by the radar equation: {} dBm transmitted, antennas of {} dBi on their axes, matched "
                  "loads. vh is receive V, transmit H.\n",
                  number_text(link.transmit_power_dbm), number_text(link.gain_dbi)));
  std::string header = std::string(key_columns) + ",range_m,rx_range_m";
  for (const char* channel : channel_names) header += fmt::format(",power_{}_dbm", channel);
  out.write(header + time_column(!sweep.times.empty()) + '\n');
  for_each_row(sweep, [&](std::size_t row, const std::string& frequency, const Look& look, const std::string& end) {
    std::string line = key_text(frequency, look) + ',' + number_text(look.transmit_range) + ',' + number_text(look.receive_range);
    const double hertz = sweep.frequencies[row % sweep.frequencies.size()];
    for (const Complex s : channels(result.total[row]))
      line += ',' + number_text(link.received_dbm(look.transmit_range, look.receive_range, hertz, s));
    out.write(line + end);
  });
  out.commit();
}

void write_parts_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result) {
  OutputFile out(file);
  const std::size_t bounces = std::max<std::size_t>(result.bounces.size(), 1);  // the columns stay where nothing was hit
  std::string header = conventions(result) + antenna_note(sweep.looks.front().far()) + key_columns;
  for (std::size_t m = 0; m < bounces; ++m) header += complex_columns('_' + bounce_name(m));
  for (const MechanismRows& mechanism : result.mechanisms) header += complex_columns('_' + mechanism.name);
  for (const ModelPart& part : result.model_parts)
    for (const char* channel : channel_names) header += fmt::format(",model_{}_{}_m", part.name, channel);
  out.write(header + time_column(!sweep.times.empty()) + '\n');
  for_each_row(sweep, [&](std::size_t row, const std::string& frequency, const Look& look, const std::string& end) {
    std::string line = key_text(frequency, look);
    for (std::size_t m = 0; m < bounces; ++m)
      line += complex_values(m < result.bounces.size() ? result.bounces[m][row] : ScatteringMatrix{});
    for (const MechanismRows& mechanism : result.mechanisms) line += complex_values(mechanism.rows[row]);
    for (const ModelPart& part : result.model_parts) line += error_values(part.rows[row]);
    out.write(line + end);
  });
  out.commit();
}

}  // namespace raytube
