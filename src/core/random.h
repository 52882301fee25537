// Random numbers by counter: a number depends on its seed, stream and index alone, so any thread draws any of them.
#pragma once

#include <array>
#include <cstdint>

#include "core/field.h"

namespace raytube {

/// Philox4x32-10: ten rounds that turn a counter of four words and a key of two into four random words. Salmon, Moraes, Dror &
/// Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11 (2011), section 3.3; multipliers and Weyl constants of its authors'
/// Random123 library. Valid when no counter is used twice with one key: all 2^128 of a key give different words.
constexpr std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  constexpr std::uint64_t multiply_0 = 0xd2511f53, multiply_1 = 0xcd9e8d57;
  constexpr std::uint32_t weyl_0 = 0x9e3779b9, weyl_1 = 0xbb67ae85;
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product_0 = multiply_0 * counter[0], product_1 = multiply_1 * counter[2];
    counter = {static_cast<std::uint32_t>(product_1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(product_1),
               static_cast<std::uint32_t>(product_0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(product_0)};
    key = {key[0] + weyl_0, key[1] + weyl_1};
  }
  return counter;
}

/// Point `index` of a stream, uniform in the unit square, ends 0 included and 1 not: multiples of 2^-53. Streams of a seed share
/// no counter, so they never overlap, whatever their length.
constexpr dvec2 random_point(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
  const auto fraction = [](std::uint64_t upper, std::uint64_t lower) {
    return static_cast<double>((upper << 32 | lower) >> 11) * 0x1p-53;
  };
  const std::array<std::uint32_t, 4> words =
      philox4x32({low(index), high(index), low(stream), high(stream)}, {low(seed), high(seed)});
  return {fraction(words[0], words[1]), fraction(words[2], words[3])};
}

}  // namespace raytube
