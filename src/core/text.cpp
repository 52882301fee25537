#include "core/text.h"

#include <algorithm>
#include <cctype>

namespace raytube {

namespace {

constexpr std::size_t longest = 60;  // [bytes]

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Bytes of the UTF-8 character that begins the text, 0 if none does (RFC 3629, section 4).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  const bool overlong = (lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xF0 && byte(1) < 0x90);
  const bool no_character = (lead == 0xED && byte(1) >= 0xA0) || (lead == 0xF4 && byte(1) >= 0x90);  // surrogates; past the last
  if (overlong || no_character) return 0;
  return std::all_of(text.begin() + 1, text.begin() + length, continues_character) ? length : 0;
}

template <class Text>
std::string joined_texts(std::span<const Text> texts, std::string_view between) {
  std::string whole;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) whole += between;
    whole += texts[i];
  }
  return whole;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

std::string_view backslash_remedy(std::string_view path) {
  return path.find('\\') == std::string_view::npos ? "" : "; write / between folders, \\ separates none here";
}

std::string quotable(std::string_view text) {
  std::string quoted;
  while (!text.empty()) {
    const std::size_t length = is_control(text[0]) ? 0 : character_length(text);
    if (quoted.size() + length > longest) return quoted + "...";
    quoted += length == 0 ? std::string_view("?") : text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return quoted;
}

std::string joined(std::span<const std::string_view> texts, std::string_view between) { return joined_texts(texts, between); }
std::string joined(std::span<const std::string> texts, std::string_view between) { return joined_texts(texts, between); }

}  // namespace raytube
