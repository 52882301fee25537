// Words and numbers of a text file, with the line number for messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/files/mesh_file.h"

namespace raytube {

/// Blank-separated words; `#` at the start of a word opens a comment to the end of the line. LF, CRLF and CR end lines.
class TextScanner {
 public:
  /// With `backslash_joins_lines` a backslash at the end of a line continues it on the next one (OBJ).
  explicit TextScanner(const MeshFile& file, bool backslash_joins_lines = false);

  /// Moves to the next line that holds a word; false at the end of the file.
  bool next_line();
  void skip_line();
  /// The rest of this line without the blanks around it, as names stand in it: no comment starts there.
  std::string_view rest_of_line();

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
  double coordinate(std::string_view word) const;
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
  bool backslash_joins_lines_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  bool on_a_line_ = false;
  bool has_lines_ = true;
};

}  // namespace raytube
