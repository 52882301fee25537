#include "output/tables/stored.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "core/csv_reader.h"
#include "core/error.h"
#include "core/text.h"
#include "output/tables/csv.h"
#include "scene/bounce_names.h"

namespace raytube {

namespace {

std::vector<StoredPart> stored_parts(const SweepResult& result) {
  std::vector<StoredPart> kept;
  for (const auto& rows : result.bounces) kept.push_back({bounce_name(kept.size()), rows});
  for (const MechanismRows& mechanism : result.mechanisms) kept.push_back({mechanism.name, mechanism.rows});
  return kept;
}

// The comment lines at the head of a file, as they stand there.
std::string head_comment(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string comment;
  for (std::string line; std::getline(in, line) && line.starts_with('#');) comment += line + '\n';
  return comment;
}

// Takes the rows of rcs.csv one after the other.
class StoredRows {
 public:
  explicit StoredRows(const CsvReader& reader) : reader_(reader) {}

  void take() {
    at_ = 0;
    const double frequency = key();
    if (!(frequency > 0.0)) throw InputError(reader_.location() + ": the frequency must be greater than 0");
    StoredLook look{key(), key(), key(), key()};
    take_channels();
    if (has("range_m")) look.range_m = key(), look.rx_range_m = key();
    if (has("time_s")) look.time_s = key(), result_.moving = true;
    find_place(frequency, look);
  }

  StoredResult finish() {
    if (result_.s.empty()) throw InputError(reader_.location() + ": no rows below the header; nothing can be converted");
    if (result_.s.size() != result_.rows()) refuse_order();
    result_.bistatic = std::ranges::any_of(result_.looks, [](const StoredLook& look) {
      return look.theta_deg != look.rx_theta_deg || look.phi_deg != look.rx_phi_deg || look.range_m != look.rx_range_m;
    });
    return std::move(result_);
  }

 private:
  bool has(const char* column) const { return at_ < reader_.columns().size() && reader_.columns()[at_] == column; }

  double key() {
    return reader_.finite_number(at_++, "write frequencies in Hz, angles in degrees, ranges in metres and times in seconds");
  }

  // Infinities and NaN are numbers here.
  double value() {
    const std::string& cell = reader_.cell(at_++);
    const std::optional<double> number = parsed_number(cell);
    if (!number)
      throw InputError(fmt::format("{}, column {}: \"{}\" is not a number; write one, -inf for zero sigma", reader_.location(),
                                   reader_.columns()[at_ - 1], quotable(cell)));
    return *number;
  }

  ChannelErrors levels() {
    ChannelErrors row;
    for (auto& receive : row)
      for (double& level : receive) level = value();
    return row;
  }

  void take_channels() {
    ScatteringMatrix& row = result_.s.emplace_back();
    for (auto& receive : row.s)
      for (Complex& s : receive) {
        const double real = value();
        s = {real, value()};
      }
    result_.sigma_dbsm.push_back(levels());
    result_.err_db.push_back(levels());
    result_.model_db.push_back(levels());
  }

  // Frequencies are those of the first look: until the first one comes again.
  void find_place(double frequency, const StoredLook& look) {
    std::vector<double>& frequencies = result_.frequency_hz;
    const std::size_t row = result_.s.size() - 1;
    if (frequencies.size() == row && (row == 0 || frequency != frequencies.front())) frequencies.push_back(frequency);
    if (row % frequencies.size() == 0) result_.looks.push_back(look);
    if (frequency != frequencies[row % frequencies.size()] || look != result_.looks.back()) refuse_order();
  }

  [[noreturn]] void refuse_order() const {
    throw InputError(
        reader_.location() +
        ": rows are not every look at every frequency, frequency fastest, up to here; sort them, or add the missing ones");
  }

  const CsvReader& reader_;
  std::size_t at_ = 0;
  StoredResult result_;
};

constexpr const char* readable = "give the path of a readable table, for example out/rcs.csv";

bool has_rcs_columns(const CsvReader& reader) {
  const std::string columns = joined(reader.columns(), ",");
  for (const bool far : {true, false})
    for (const bool moving : {true, false})
      if (columns == rcs_columns(far, moving)) return true;
  return false;
}

}  // namespace

StoredResult stored_sweep(const Sweep& sweep) {
  StoredResult stored;
  stored.frequency_hz = sweep.frequencies;
  for (std::size_t i = 0; i < sweep.looks.size(); ++i) stored.looks.push_back(stored_look(sweep, i));
  stored.bistatic = sweep.bistatic;
  stored.moving = !sweep.times.empty();
  return stored;
}

StoredResult stored(const Sweep& sweep, const SweepResult& result, const std::string& note) {
  StoredResult stored = stored_sweep(sweep);
  stored.s = result.total;
  for (auto* levels : {&stored.sigma_dbsm, &stored.err_db, &stored.model_db}) levels->reserve(sweep.rows());
  for (std::size_t row = 0; row < sweep.rows(); ++row) {
    const RcsLevels levels = rcs_levels(result, row);
    stored.sigma_dbsm.push_back(levels.sigma_dbsm);
    stored.err_db.push_back(levels.err_db);
    stored.model_db.push_back(levels.model_db);
  }
  stored.error_m = result.error;
  stored.model_m = result.model;
  if (!result.mechanisms.empty()) stored.parts = stored_parts(result);
  for (const ModelPart& part : result.model_parts)
    if (!part.rows.empty()) stored.model_parts.push_back({part.name, part.rows});
  stored.incoherent_m2 = result.incoherent;
  stored.comment = rcs_comment(sweep, result, note);
  return stored;
}

double stored_bytes_per_row(std::size_t columns) {
  constexpr double levels = 5.0, model_parts = 16.0, buffers = 1.0;
  const double kept = sizeof(ScatteringMatrix) + (levels + buffers) * sizeof(ChannelErrors);
  constexpr double copies = 2.0;  // a file is made in memory first
  if (columns == 0) return copies * kept;
  return copies * (kept + static_cast<double>(columns) * sizeof(ScatteringMatrix) + model_parts * sizeof(ChannelErrors));
}

Sweep sweep_of(const StoredResult& result) {
  Sweep sweep{result.frequency_hz, {}, result.bistatic};
  for (const StoredLook& look : result.looks)
    sweep.looks.push_back({{look.theta_deg * degree, look.phi_deg * degree},
                           {look.rx_theta_deg * degree, look.rx_phi_deg * degree},
                           look.range_m,
                           look.rx_range_m});
  if (result.moving)
    for (const StoredLook& look : result.looks) sweep.times.push_back(look.time_s);
  return sweep;
}

bool has_rcs_columns(const std::filesystem::path& file) { return has_rcs_columns(CsvReader(file, readable)); }

StoredResult read_rcs_csv(const std::filesystem::path& file) {
  CsvReader reader(file, readable);
  if (!has_rcs_columns(reader))
    throw InputError(fmt::format("{}: its columns are not those of rcs.csv, {}; give a table that raytube has written",
                                 file.string(),
                                 "freq_hz,theta_deg, ... to model_hh_db, and perhaps range_m,rx_range_m and time_s"));
  StoredRows rows(reader);
  while (reader.next()) rows.take();
  StoredResult result = rows.finish();
  result.comment = head_comment(file);
  return result;
}

}  // namespace raytube
