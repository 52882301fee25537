// Numbers as they stand in binary files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace raytube {

/// The number of a type at some bytes, of which there must be as many; `swapped`: their order is not the machine's.
template <class Number>
Number number_at(const char* bytes, bool swapped = false) {
  std::array<char, sizeof(Number)> own;
  std::memcpy(own.data(), bytes, own.size());
  if (swapped) std::ranges::reverse(own);
  return std::bit_cast<Number>(own);
}

/// The types of numbers in mesh files. A double holds each of them exactly.
enum class NumberType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a number.
constexpr std::size_t size_of(NumberType type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

/// The same of a type that the file names.
inline double number_at(NumberType type, const char* bytes, bool swapped = false) {
  const auto as = [&](auto zero) { return static_cast<double>(number_at<decltype(zero)>(bytes, swapped)); };
  if (type == NumberType::float32) return as(0.0f);
  if (type == NumberType::float64) return as(0.0);
  if (type == NumberType::int32) return as(std::int32_t{0});
  if (type == NumberType::uint32) return as(std::uint32_t{0});
  if (type == NumberType::int16) return as(std::int16_t{0});
  if (type == NumberType::uint16) return as(std::uint16_t{0});
  return type == NumberType::int8 ? as(std::int8_t{0}) : as(std::uint8_t{0});
}

}  // namespace raytube
