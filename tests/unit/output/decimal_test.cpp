// Numbers as text: shortest, exact, and as typed.
#include <gtest/gtest.h>

#include <charconv>
#include <limits>

#include "core/decimal.h"
#include "core/field.h"

namespace raytube {
namespace {

double read_back(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

TEST(Decimal, TextReadsBackToTheSameBits) {
  for (const double x : {0.1, 1.0 / 3.0, -2.5e-300, 94e9, 5e-324, std::numeric_limits<double>::max(), 123456789.123456789})
    EXPECT_EQ(read_back(number_text(x)), x);
}

TEST(Decimal, ShortAndWithoutSurprises) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(94e9), "94000000000");
  EXPECT_EQ(number_text(-0.0), "0");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::infinity()), "-inf");
  EXPECT_EQ(number_text(-std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Decimal, DegreesComeBackAsTyped) {
  for (int i = -36000; i <= 36000; ++i) {
    const double typed = i / 100.0;
    ASSERT_EQ(decimal_degrees(typed * degree), typed);
  }
  for (const double typed : {54.7356103172453, 1e-7, 123456.789, -0.3}) EXPECT_EQ(decimal_degrees(typed * degree), typed);
}

TEST(Decimal, DegreesGiveBackTheRadians) {
  for (const double typed : {54.735610317245346, 35.264389682754654, 1.0 / 3.0}) {
    const double radians = typed * degree;
    EXPECT_EQ(decimal_degrees(radians) * degree, radians);
  }
}

TEST(Decimal, ALimitIsNeverToldTooLarge) {
  EXPECT_EQ(rounded_down_text(29979.2458), "29900");
  EXPECT_EQ(rounded_down_text(0.29979), "0.299");
  EXPECT_EQ(rounded_down_text(158.0), "158");
  for (double x = 1.3e-300; x < 1e300; x *= 1.7)
    ASSERT_TRUE(std::stod(rounded_down_text(x)) <= x && std::stod(rounded_down_text(x)) > 0.99 * x) << x;
}

TEST(Decimal, ScaleSetsTheLastDigit) {
  EXPECT_EQ(rounded_at_scale(0.1 + 0.2, 10.0), 0.3);
  EXPECT_EQ(rounded_at_scale(1e-17, 10.0), 0.0);
  EXPECT_EQ(rounded_at_scale(0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace raytube
