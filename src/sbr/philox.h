// Random numbers by index: the same for any order and any number of threads.
#pragma once

#include <array>
#include <cstdint>

namespace raytube {

/// Philox4x32-10 (Salmon, Moraes, Dror & Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC 2011, sec. 3.3): four words of
/// 32 random bits for each counter and key.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ull * counter[0], b = 0xCD9E8D57ull * counter[2];
    counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
               static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

/// Two numbers of [0, 1), of 53 bits each, that belong to `index` in the sequence of `seed`.
inline std::array<double, 2> random_pair(std::uint64_t seed, std::uint64_t index) {
  const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
  const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
  const std::array<std::uint32_t, 4> words = philox({low(index), high(index), 0, 0}, {low(seed), high(seed)});
  const auto unit = [](std::uint32_t a, std::uint32_t b) {
    return 0x1p-53 * static_cast<double>((std::uint64_t{a} << 32 | b) >> 11);
  };
  return {unit(words[0], words[1]), unit(words[2], words[3])};
}

}  // namespace raytube
