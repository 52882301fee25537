#include "output/report/packed.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace raytube {

namespace {

constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

// RFC 4648, section 4.
std::string base64(const std::string& bytes) {
  std::string text;
  text.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t j) {
      return j < bytes.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[j])) : 0u;
    };
    const std::uint32_t bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += digits[bits >> 18];
    text += digits[bits >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[bits >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[bits & 63] : '=';
  }
  return text;
}

template <class Number>
std::string packed(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return base64(bytes);
}

std::int16_t hundredths(double level_db) {
  constexpr double least = -32768.0, most = 32767.0;
  if (!(level_db > 0.01 * least)) return static_cast<std::int16_t>(least);
  return static_cast<std::int16_t>(std::min(std::round(100.0 * level_db), most));
}

}  // namespace

std::string packed_levels(const std::vector<double>& levels_db) {
  std::vector<std::int16_t> numbers(levels_db.size());
  std::ranges::transform(levels_db, numbers.begin(), hundredths);
  return packed(numbers);
}

std::string packed_floats(const std::vector<double>& values) { return packed(std::vector<float>(values.begin(), values.end())); }

std::string packed_indices(const std::vector<std::uint32_t>& indices) { return packed(indices); }

}  // namespace raytube
