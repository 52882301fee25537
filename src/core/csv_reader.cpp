#include "core/csv_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

constexpr std::size_t longest_line = 1'000'000;  // [bytes]
constexpr const char* blanks = " \t\r\"";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

char separator_of(const std::string& header) {
  for (const char separator : {',', ';'})
    if (header.find(separator) != std::string::npos) return separator;
  return ' ';
}

std::vector<std::string> cells_between_blanks(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != std::string::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end;
  }
  return cells;
}

// A cell that begins with a double quote has its separators between quotes; the line may have lost its last quote.
std::size_t end_of_cell(const std::string& line, std::size_t begin, char separator) {
  const std::size_t first = line.find_first_not_of(" \t", begin);
  bool quoted = false;
  const bool may_be_quoted = first != std::string::npos && line[first] == '"';
  for (std::size_t i = begin; i < line.size(); ++i) {
    if (may_be_quoted && line[i] == '"') quoted = !quoted;
    if (line[i] == separator && !quoted) return i;
  }
  return line.size();
}

std::vector<std::string> cells_of(const std::string& line, char separator) {
  if (separator == ' ') return cells_between_blanks(line);
  std::vector<std::string> cells;
  for (std::size_t at = 0; at <= line.size();) {
    const std::size_t end = end_of_cell(line, at, separator);
    cells.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& file, const std::string& remedy) : file_(file) {
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) stream_.open(file, std::ios::binary);  // a pipe may never end
  if (!stream_.is_open())
    throw InputError(fmt::format("{}: cannot be read; {}{}", file.string(), remedy, backslash_remedy(file.string())));
  if (next_line()) columns_ = std::move(cells_);
}

bool CsvReader::next() {
  if (!next_line()) return false;
  if (cells_.size() != columns_.size())
    throw InputError(fmt::format("{}: {} values where the header names {} columns; correct the line", location(), cells_.size(),
                                 columns_.size()));
  return true;
}

double CsvReader::finite_number(std::size_t column, const std::string& remedy) const {
  const std::optional<double> value = parsed_number(cell(column));
  if (!value || !std::isfinite(*value))
    throw InputError(fmt::format("{}, column {}: \"{}\" is not a finite number; {}", location(), quotable(columns_[column]),
                                 quotable(cell(column)), remedy));
  return *value;
}

std::string CsvReader::location() const { return fmt::format("{}, line {}", file_.string(), line_); }

bool CsvReader::read_line(std::string& line) {
  line.clear();
  std::streambuf& bytes = *stream_.rdbuf();
  int c = bytes.sbumpc();
  if (c == std::char_traits<char>::eof()) return false;
  ++line_;
  for (; c != '\n' && c != std::char_traits<char>::eof(); c = bytes.sbumpc()) {
    line += static_cast<char>(c);
    if (line.size() > longest_line)
      throw InputError(
          fmt::format("{} is longer than {} bytes; give a table with a line for each row", location(), longest_line));
  }
  if (line_ > 1) return true;
  if (is_utf16(line)) throw InputError(file_.string() + ": is text in UTF-16; save it as UTF-8 or ASCII");
  if (line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
  return true;
}

bool CsvReader::next_line() {
  for (std::string line; read_line(line);) {
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    if (separator_ == '\0') separator_ = separator_of(line);
    cells_ = cells_of(line, separator_);
    return true;
  }
  return false;
}

std::optional<double> parsed_number(const std::string& text) {
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* last = text.data() + text.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last) return std::nullopt;
  return value;
}

}  // namespace raytube
