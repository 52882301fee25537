// Words and numbers of a text file, with the line number for messages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mesh/files/mesh_file.h"

namespace raytube {

/// The bytes of a text file before the zeros and Ctrl-Z, with which old programs pad its end.
std::string_view without_padding(std::string_view bytes);

/// The digits of a number as it is written, from the first one that is not 0 to the exponent.
int written_digits(std::string_view number);

/// The value of a text that is a number as a whole; below the smallest double what is nearest, above the largest infinity.
std::optional<double> number_of(std::string_view text);

/// Blank-separated words; `#` at the start of a word opens a comment to the end of the line. LF, CRLF and CR end lines.
/// Padding at the end of the file is no part of it.
class TextScanner {
 public:
  /// With `backslash_joins_lines` a backslash at the end of a line continues it on the next one (OBJ).
  explicit TextScanner(const MeshFile& file, bool backslash_joins_lines = false);

  /// Moves to the next line that holds a word; false at the end of the file.
  bool next_line();
  void skip_line();
  /// The rest of this line without the blanks around it, as names stand in it: no comment starts there.
  std::string_view rest_of_line();
  /// Goes back to where `rest` begins, the end of what rest_of_line() returned last.
  void read_again(std::string_view rest) { position_ = static_cast<std::size_t>(rest.data() - bytes_.data()); }

  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word of this line or of a later one; empty at the end of the file.
  std::string_view word_of_any_line();

  /// The next bytes as they stand, for files with binary numbers between words; rejects the file if there are fewer. No line is
  /// named from there on.
  std::string_view raw_bytes(std::size_t count);

  /// The value of a word; rejects the file if it is not a number.
  double number(std::string_view word) const;
  /// The value of a word as number() finds it; rejects infinity and NaN too.
  double coordinate(std::string_view word);
  /// Counts the digits of a coordinate that is read as number() finds it.
  void note_digits(std::string_view word);
  /// The most digits of a coordinate so far.
  int digits() const { return digits_; }
  /// The value of a word that is a whole number and not negative; rejects the file otherwise.
  std::uint64_t count(std::string_view word) const;

  std::size_t line() const { return line_; }
  std::size_t position() const { return position_; }

  /// Throws InputError: file, line, then `sentence`.
  [[noreturn]] void reject(const std::string& sentence) const;

 private:
  bool at_line_end() const;
  bool at_joined_line() const;
  void pass_line_end();
  void skip_blanks();

  const MeshFile& file_;
  std::string_view bytes_;
  bool backslash_joins_lines_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  int digits_ = 0;
  bool on_a_line_ = false;
  bool has_lines_ = true;
};

}  // namespace raytube
