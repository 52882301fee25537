// The results as tables: one row per look and frequency, looks slowest, frequency fastest.
#pragma once

#include <array>
#include <filesystem>

#include "sweep.h"

namespace raytube {

/// Receive polarisation first, as in the names of columns; the order of channels in every output.
inline constexpr std::array<const char*, 4> channel_names = {"vv", "vh", "hv", "hh"};

/// sigma of one amplitude [dBsm]; -inf for zero. Does not underflow where |S|^2 would.
double sigma_dbsm(Complex s);

/// err_pq_db of a row, in the order of channel_names: 20 log10(1 + error / max(|S_pq|, S_max / 100)), S_max the largest
/// amplitude.
std::array<double, 4> error_levels_db(const ScatteringMatrix& s, const ChannelErrors& errors);

/// rcs.csv: complex S and sigma of the four channels.
void write_rcs_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result);

/// channels.csv: magnitude sqrt(sigma) [m] and phase [rad] received in V and H, one row per transmit polarisation.
void write_channels_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result);

/// parts.csv: complex S of bounce 1, 2, ..., of the edges at first order, of all their higher orders together, and of what
/// their waves paint on other surfaces, side by side; they add up to rcs.csv. Bounce 1 has its columns even where nothing was
/// hit. Needs a result with parts.
void write_parts_csv(const std::filesystem::path& file, const Sweep& sweep, const SweepResult& result);

}  // namespace raytube
