// A result from any source, read back from a table: raytube's rcs.csv or another program's file.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/field.h"
#include "output/netcdf/stored_result.h"
#include "output/tables/column_map.h"

namespace raytube {

struct ResultTable {
  /// What tells rows apart: frequency [Hz], directions to transmitter and receiver [degrees], time [s].
  enum Key { frequency, theta, phi, rx_theta, rx_phi, time, keys };
  using Keys = std::array<double, keys>;

  struct Row {
    Keys key{};                        // 0 where the table has none
    std::array<Complex, 4> s{};        // [m], where the channel has phase
    std::array<double, 4> sigma_dbsm;  // -inf for zero
  };

  std::filesystem::path file;
  std::array<bool, keys> has_key{};
  std::array<bool, 4> has_channel{}, has_phase{};
  std::array<bool, 4> has_level{};  // read from a column in dBsm
  std::vector<Row> rows;
};

inline constexpr std::array<const char*, ResultTable::keys> key_names = {"freq_hz",      "theta_deg",  "phi_deg",
                                                                         "rx_theta_deg", "rx_phi_deg", "time_s"};

/// Azimuths 360 degrees apart are the same direction.
constexpr bool is_azimuth(ResultTable::Key key) { return key == ResultTable::phi || key == ResultTable::rx_phi; }

/// Reads a table (see CsvReader) with a header, in any order of columns; other columns are ignored.
///   Keys: freq_hz or freq_ghz; theta_deg, phi_deg to the transmitter; rx_theta_deg, rx_phi_deg to the receiver, which are those
///   to the transmitter where they are missing; time_s. With theta_i_deg, phi_i_deg these lead to the transmitter, theta_deg,
///   phi_deg to the receiver. At least one is needed. Channels pq = vv, vh, hv, hh: re_pq and im_pq [m]; or else magnitude_pq,
///   the root of sigma [m], sigma_pq_m2 or sigma_pq_dbsm, and perhaps phase_pq_rad. At least one is needed. With tx_pol, v or h,
///   a row holds one transmit polarisation, as in channels.csv: v_magnitude [m], v_phase_rad, h_magnitude [m], h_phase_rad as
///   received. Rows with the same keys become one.
/// A netCDF file (.nc) that raytube has written has all of these, and takes no map.
/// `map` says which column has another name or unit: a unit at the end of that name, in brackets or behind an underscore, counts
/// where no factor is given. `option` is what a sentence calls the map. Throws InputError with line and column.
ResultTable read_result_table(const std::filesystem::path& file, const ColumnMap& map = {},
                              const std::string& option = "--result-columns");

/// Whether a name ends as those of the Radar Explorer Toolkit do, whose files are read where pandas is, which writes their
/// tables.
bool is_radar_explorer_name(const std::filesystem::path& file);

/// A result that is at hand; sentences call it `name`. A channel without a single number is none. Throws InputError for other
/// rows without a number.
ResultTable table_of(const StoredResult& stored, const std::filesystem::path& name);

/// Keeps the rows whose key lies in low...high, ends included; an azimuth may lie there by full turns, which are then taken off
/// it. A table without that key keeps all. Throws InputError if none is left.
void keep_rows(ResultTable& table, ResultTable::Key key, double low, double high);

}  // namespace raytube
