// The results as tables: one row per look and frequency, looks slowest, frequency fastest. Of a scene that moves the last column
// is the look's time.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "output/netcdf/stored_result.h"
#include "scene/results.h"
#include "scene/sweep.h"

namespace raytube {

/// Receive polarisation first, as in the names of columns; the order of channels in every output.
inline constexpr std::array<const char*, 4> channel_names = {"vv", "vh", "hv", "hh"};

/// sigma of one amplitude [dBsm]; -inf for zero. Does not underflow where |S|^2 would.
double sigma_dbsm(Complex s);

/// "(1, 0, 0)", as comment lines of tables have directions.
std::string vector_text(const dvec3& vector);

/// err_pq_db of a row, in the order of channel_names: 20 log10(1 + error / max(|S_pq|, S_max / 100)), S_max the largest
/// amplitude.
std::array<double, 4> error_levels_db(const ScatteringMatrix& s, const ChannelErrors& errors);

/// The columns that tell rows apart, and the comment lines at the head of every table.
inline constexpr const char* key_columns = "freq_hz,theta_deg,phi_deg,rx_theta_deg,rx_phi_deg";
std::string conventions(const SweepResult& result);

/// A row's values under key_columns; the frequency as number_text() has it.
std::string key_text(const std::string& frequency, const Look& look);

/// The head of rcs.csv: comment lines, of which `note` is the last one, or empty; and the names of its columns.
std::string rcs_comment(const Sweep& sweep, const SweepResult& result, const std::string& note);
std::string rcs_columns(bool far, bool moving);

StoredLook stored_look(const Sweep& sweep, std::size_t look);

/// What a row of rcs.csv says of its S.
struct RcsLevels {
  ChannelErrors sigma_dbsm, err_db, model_db;
};
RcsLevels rcs_levels(const SweepResult& result, std::size_t row);

/// rcs.csv: complex S and sigma of the four channels. `note` is a further comment line at its head, or empty.
void write_rcs_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result,
                   const std::string& note = "");

/// The same of a stored result: the same bytes. What rcs.csv has no columns for is not written.
void write_rcs_csv(const std::filesystem::path& file, const StoredResult& result);

/// channels.csv: magnitude sqrt(sigma) [m] and phase [rad] received in V and H, one row per transmit polarisation.
void write_channels_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result);

/// incoherent.csv: sigma of what rough surfaces scatter incoherently, per transmit polarisation, both receive polarisations
/// together. Needs a result with it.
void write_incoherent_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result);

/// power.csv: what the receiver gets in each channel [dBm]. Of antennas at a finite distance.
void write_power_csv(const std::filesystem::path& file, const Sweep& sweep, const LinkBudget& link, const SweepResult& result);

/// parts.csv: complex S by mechanism, side by side (plan/mechanism.h); they add up to rcs.csv. Bounce 1 has its columns even
/// where nothing was hit. Then the parts of the model uncertainty [m]. Needs a result with parts.
void write_parts_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result);

}  // namespace raytube
