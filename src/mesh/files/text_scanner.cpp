#include "mesh/files/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "core/text.h"

namespace raytube {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

std::string_view without_padding(std::string_view bytes) {
  return bytes.substr(0, bytes.find_last_not_of(std::string_view("\0\x1A", 2)) + 1);
}

int written_digits(std::string_view number) {
  int digits = 0;
  for (const char c : number) {
    if (c == 'e' || c == 'E') break;
    if ((c > '0' && c <= '9') || (c == '0' && digits > 0)) ++digits;
  }
  return digits;
}

std::optional<double> number_of(std::string_view text) {
  const char *first = text.data() + (text.starts_with('+') ? 1 : 0), *last = text.data() + text.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (end != last || error == std::errc::invalid_argument) return {};
  return error == std::errc::result_out_of_range ? std::strtod(std::string(text).c_str(), nullptr) : value;
}

TextScanner::TextScanner(const MeshFile& file, bool backslash_joins_lines)
    : file_(file), bytes_(without_padding(file.bytes)), backslash_joins_lines_(backslash_joins_lines) {
  if (is_utf16(bytes_)) file_.reject("is text in UTF-16; save it as UTF-8 or ASCII");
  if (bytes_.starts_with(byte_order_mark)) position_ = byte_order_mark.size();
}

bool TextScanner::at_line_end() const {
  return position_ >= bytes_.size() || bytes_[position_] == '\n' || bytes_[position_] == '\r';
}

bool TextScanner::at_joined_line() const {
  if (!backslash_joins_lines_ || bytes_[position_] != '\\' || position_ + 1 >= bytes_.size()) return false;
  const char next = bytes_[position_ + 1];
  return next == '\n' || next == '\r';
}

void TextScanner::pass_line_end() {
  if (bytes_.compare(position_, 2, "\r\n") == 0) ++position_;
  ++position_;
  ++line_;
}

void TextScanner::skip_blanks() {
  while (!at_line_end()) {
    if (at_joined_line()) {
      ++position_;
      pass_line_end();
    } else if (is_blank(bytes_[position_])) {
      ++position_;
    } else {
      break;
    }
  }
  if (!at_line_end() && bytes_[position_] == '#')
    while (!at_line_end()) ++position_;
}

void TextScanner::skip_line() {
  while (!at_line_end()) ++position_;
  if (position_ < bytes_.size()) pass_line_end();
}

std::string_view TextScanner::rest_of_line() {
  const std::size_t begin = position_;
  while (!at_line_end()) ++position_;
  std::string_view rest = bytes_.substr(begin, position_ - begin);
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  return rest;
}

bool TextScanner::next_line() {
  if (on_a_line_) skip_line();
  on_a_line_ = true;
  for (skip_blanks(); at_line_end(); skip_blanks()) {
    if (position_ >= bytes_.size()) return false;
    pass_line_end();
  }
  return true;
}

std::string_view TextScanner::word() {
  skip_blanks();
  const std::size_t begin = position_;
  while (!at_line_end() && !is_blank(bytes_[position_]) && !at_joined_line()) ++position_;
  return bytes_.substr(begin, position_ - begin);
}

std::string_view TextScanner::word_of_any_line() {
  std::string_view found = word();
  while (found.empty() && position_ < bytes_.size()) {
    pass_line_end();
    found = word();
  }
  return found;
}

std::string_view TextScanner::raw_bytes(std::size_t count) {
  has_lines_ = false;
  if (bytes_.size() - position_ < count) reject("ends before its last number; it is cut short, export it again");
  const std::string_view bytes = bytes_.substr(position_, count);
  position_ += count;
  return bytes;
}

double TextScanner::number(std::string_view word) const {
  if (word.empty()) reject("a number is missing; the file is cut short or damaged, export it again");
  const std::optional<double> value = number_of(word);
  if (!value) reject(fmt::format("'{}' is not a number; correct the line", quotable(word)));
  return *value;
}

void TextScanner::note_digits(std::string_view word) {
  if (std::ssize(word) > digits_) digits_ = std::max(digits_, written_digits(word));
}

double TextScanner::coordinate(std::string_view word) {
  const double value = number(word);
  note_digits(word);
  if (!std::isfinite(value))
    reject(fmt::format("the coordinate '{}' is not finite; correct it or export the mesh again", quotable(word)));
  return value;
}

std::uint64_t TextScanner::count(std::string_view word) const {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size() || error != std::errc())
    reject(fmt::format("a count was expected instead of '{}'; the file is damaged, export it again", quotable(word)));
  return value;
}

void TextScanner::reject(const std::string& sentence) const {
  file_.reject(has_lines_ ? fmt::format("line {}: {}", line_, sentence) : sentence);
}

}  // namespace raytube
