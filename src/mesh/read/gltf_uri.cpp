#include "mesh/read/gltf_uri.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>

#include "core/text.h"

namespace raytube {

namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> digit_values() {
  std::array<std::uint8_t, 256> values;
  values.fill(no_digit);
  for (std::size_t i = 0; i < base64_digits.size(); ++i) values[static_cast<unsigned char>(base64_digits[i])] = i & 63;
  return values;
}

std::optional<std::string> decoded_base64(std::string_view text) {
  static constexpr std::array<std::uint8_t, 256> values = digit_values();
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::uint8_t value = values[static_cast<unsigned char>(text[i])];
    if (value == no_digit) return std::nullopt;
    bits = bits << 6 | value;
    if (const std::size_t left = 6 - 2 * (i % 4); i % 4 != 0) bytes += static_cast<char>(bits >> left & 0xFF);
  }
  return bytes;
}

std::string without_percents(std::string_view text) {
  std::string decoded;
  for (; !text.empty(); text.remove_prefix(1)) {
    unsigned value = 0;
    const char* digits = text.data() + 1;
    const bool is_code =
        text.front() == '%' && text.size() > 2 && std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
    decoded += is_code ? static_cast<char>(value) : text.front();
    if (is_code) text.remove_prefix(2);
  }
  return decoded;
}

}  // namespace

std::optional<std::string> data_of_uri(std::string_view uri) {
  static constexpr std::string_view mark = ";base64,";
  const std::size_t end = uri.find(mark);
  if (!uri.starts_with("data:") || end == std::string_view::npos) return std::nullopt;
  return decoded_base64(uri.substr(end + mark.size()));
}

std::optional<std::string> path_of_uri(std::string_view uri) {
  if (uri.find(':') != std::string_view::npos) return std::nullopt;
  const std::string path = without_percents(uri);
  const std::filesystem::path file = std::filesystem::path(path).lexically_normal();
  const bool outside = file.is_absolute() || file.empty() || *file.begin() == "..";
  const bool printable = is_utf8(path) && std::ranges::all_of(path, [](char c) { return c < 0 || (c >= ' ' && c != '\x7F'); });
  return outside || !printable ? std::nullopt : std::optional(path);
}

}  // namespace raytube
