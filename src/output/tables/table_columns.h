// Columns of a table by their names, in this project's words or another's, and the channels that its rows hold.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/csv_reader.h"
#include "core/field.h"
#include "output/tables/column_map.h"

namespace raytube {

/// A column, and what makes its cells ours.
struct ColumnSource {
  std::optional<std::size_t> column;
  double factor = 1.0, offset = 0.0;

  explicit operator bool() const { return column.has_value(); }
};

/// Columns of one channel: real and imaginary part, or a level and perhaps a phase.
struct ChannelSource {
  ColumnSource re, im, magnitude, power, level, phase;

  bool any() const { return re || magnitude || power || level; }
  bool has_level() const { return level && !re && !magnitude && !power; }
  bool has_phase() const { return re || (any() && phase); }
};

/// Of the four channels. With a column `transmit` a row holds those of one transmit polarisation.
struct ChannelColumns {
  std::array<ChannelSource, 4> channels;
  std::optional<std::size_t> transmit;
};

/// Names of columns, in small or capital letters.
class TableHeader {
 public:
  /// `location` and `option` are what sentences call the header and the map. Throws InputError for a map that names no column.
  TableHeader(std::string location, std::vector<std::string> names, ColumnMap map, std::string option);

  /// The column that holds `ours`, if there is one.
  ColumnSource find(const std::string& ours) const;
  /// What to do about a missing column that has another name.
  std::string remedy(const std::string& ours) const;
  [[noreturn]] void reject(const std::string& sentence) const;

 private:
  void check_unit_of_sigma(const ColumnChoice& choice) const;
  std::optional<std::size_t> column(const std::string& name) const;

  std::string location_;
  std::vector<std::string> names_;
  ColumnMap map_;
  std::string option_;
};

/// Throws InputError if there is no channel.
ChannelColumns find_channels(const TableHeader& header);

/// A cell of the row that the reader has come to, in our unit. Throws InputError that ends with `remedy` if it is no finite
/// number.
double value_of(const CsvReader& row, const ColumnSource& source, const std::string& remedy);

struct ChannelValue {
  Complex s;          // [m]
  double sigma_dbsm;  // as it stands there, where it does
};

/// Of a channel that has columns. Throws InputError for what is no radar cross-section.
ChannelValue channel_value(const CsvReader& row, const ChannelSource& source);

/// 0 for V, 1 for H. Throws InputError for anything else.
int transmit_of(const CsvReader& reader, std::size_t column);

}  // namespace raytube
