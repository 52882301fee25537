// The counter-based generator: its authors' answers, evenness, and independence of streams.
#include "core/random.h"

#include <gtest/gtest.h>

#include <set>

namespace raytube {
namespace {

using Words = std::array<std::uint32_t, 4>;

// The known answers for philox4x32, 10 rounds, in the file kat_vectors of the Random123 library: counter and key all zeros, all
// ones, and the digits of pi.
TEST(Random, KnownAnswersOfPhilox) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}), (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// The words of the first known answer, as fractions of the unit interval.
TEST(Random, APointIsTheLeading53BitsOfTwoWordsEach) {
  const dvec2 point = random_point(0, 0, 0);
  EXPECT_EQ(point.x, static_cast<double>(0x6627e8d5e169c58dull >> 11) / 9007199254740992.0);
  EXPECT_EQ(point.y, static_cast<double>(0xbc57ac4c9b00dbd8ull >> 11) / 9007199254740992.0);
}

// Every half of seed, stream and index counts.
TEST(Random, SeedStreamAndIndexEachNameOtherPoints) {
  std::set<double> drawn;
  int points = 0;
  for (const std::uint64_t seed : {0ull, 1ull, 1ull << 32})
    for (const std::uint64_t stream : {0ull, 1ull, 1ull << 32})
      for (const std::uint64_t index : {0ull, 1ull, 1ull << 32}) drawn.insert(random_point(seed, stream, index).x), ++points;
  EXPECT_EQ(drawn.size(), static_cast<std::size_t>(points));
}

// Counts of points in a grid of 16 x 16 cells: chi-square with 255 degrees of freedom has mean 255 and standard deviation
// sqrt(510) = 22.6; 4 of these to either side. The seed is fixed, so this never fails by chance.
TEST(Random, PointsFillTheUnitSquareEvenly) {
  constexpr int side = 16, points = 1 << 16;
  std::array<int, side * side> counts{};
  for (std::uint64_t i = 0; i < points; ++i) {
    const dvec2 point = static_cast<double>(side) * random_point(11, 3, i);
    ++counts.at(static_cast<std::size_t>(point.x) * side + static_cast<std::size_t>(point.y));
  }
  constexpr double expected = static_cast<double>(points) / (side * side);
  double chi_square = 0.0;
  for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
  EXPECT_NEAR(chi_square, 255.0, 4.0 * 22.6);
}

}  // namespace
}  // namespace raytube
