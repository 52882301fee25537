// Tables in text files, wherever they come from: spreadsheets, other programs, raytube itself.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace raytube {

/// Reads a table row by row. Lines that begin with '#' and empty lines are passed over; the first line left names the columns.
/// Columns are separated by commas, or else semicolons, or else blanks, as the header shows. A byte order mark, blanks and
/// double quotes round a cell are dropped; commas and semicolons between such quotes are the cell's own.
class CsvReader {
 public:
  /// Throws InputError, which ends with `remedy`, if the file cannot be read; columns() is empty if it holds no line.
  CsvReader(const std::filesystem::path& file, const std::string& remedy);

  const std::vector<std::string>& columns() const { return columns_; }

  /// Goes to the next row; false behind the last one. Throws InputError for a row with more or fewer cells than columns.
  bool next();

  const std::string& cell(std::size_t column) const { return cells_[column]; }

  /// The cell as a number. Throws InputError, which ends with `remedy`, if it is none or not finite.
  double finite_number(std::size_t column, const std::string& remedy) const;

  /// The line that was read last: "looks.csv, line 7".
  std::string location() const;

 private:
  bool read_line(std::string& line);  // as it stands in the file, without its end
  bool next_line();

  std::filesystem::path file_;
  std::ifstream stream_;
  std::size_t line_ = 0;
  char separator_ = '\0';  // '\0': not known yet
  std::vector<std::string> columns_, cells_;
};

/// The number that the whole of `text` stands for: "1.5", "+2", "-inf", "nan".
std::optional<double> parsed_number(const std::string& text);

}  // namespace raytube
