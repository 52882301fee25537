#include "core/decimal.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/field.h"

namespace raytube {

namespace {

double read_back(const std::string& text) {
  double value = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value == 0.0 ? 0.0 : value;  // never -0
}

}  // namespace

double rounded_to_15_digits(double x) { return std::isfinite(x) ? read_back(fmt::format("{:.15g}", x)) : x; }

double rounded_at_scale(double x, double scale) {
  if (!(scale > 0.0) || !std::isfinite(scale)) return x;
  const int decimals = std::max(0, 12 - static_cast<int>(std::floor(std::log10(scale))));
  return read_back(fmt::format("{:.{}f}", x, decimals));
}

double decimal_degrees(double radians) {
  const double quotient = radians / degree;
  for (const int digits : {15, 16})
    if (const double typed = read_back(fmt::format("{:.{}g}", quotient, digits)); typed * degree == radians) return typed;
  return quotient == 0.0 ? 0.0 : quotient;
}

std::string number_text(double x) {
  if (x == 0.0) return "0";
  return std::isnan(x) ? "nan" : fmt::format("{}", x);
}

std::string rounded_down_text(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 2.0);
  const auto rounded = [&](double units) { return read_back(fmt::format("{:.3g}", units * unit)); };
  const double floor = std::floor(x / unit);
  return number_text(rounded(floor) <= x ? rounded(floor) : rounded(floor - 1.0));
}

}  // namespace raytube
