// The library of media against figures printed by others, and against its own page.
#include "case/materials/media.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

#include "core/error.h"

namespace raytube {
namespace {

constexpr double giga = 1e9;

Complex permittivity(std::string_view name, double frequency_hz) {
  return library_medium(name, frequency_hz).value().permittivity;
}

double conductivity(std::string_view name, double frequency_hz) {
  return -permittivity(name, frequency_hz).imag() * 2.0 * pi * frequency_hz * 8.8541878128e-12;
}

TEST(Media, UnknownNameIsNoMedium) {
  EXPECT_FALSE(library_medium("unobtainium", 10 * giga));
  EXPECT_FALSE(library_medium("", 10 * giga));
  EXPECT_FALSE(library_medium("Glass", 10 * giga));
}

// eps'' = 17.98 sigma / f: the constant as printed in ITU-R P.2040, four digits; sigma = c f^d is c at 1 GHz.
TEST(Media, PowerLawsOfTheRecommendation) {
  EXPECT_EQ(permittivity("concrete", giga).real(), 5.24);
  EXPECT_NEAR(-permittivity("concrete", giga).imag(), 17.98 * 0.0462, 5e-4);
  EXPECT_NEAR(conductivity("concrete", 100 * giga), 0.0462 * std::pow(100.0, 0.7822), 1e-12);
  EXPECT_NEAR(conductivity("glass", 77 * giga), 0.0036 * std::pow(77.0, 1.3394), 1e-12);
}

// Values of the same model for dry skin as others print them (BioMedical Engineering OnLine 2018, doi 10.1186/s12938-018-0473-9,
// table 3): half of the last digit.
TEST(Media, DrySkinAsPrinted) {
  struct Printed {
    double frequency_hz, permittivity, half_digit, conductivity, half_digit_of_it;
  };
  for (const Printed& p : {Printed{1e4, 1133.6, 0.05, 0.00020, 5e-6},
                           {1e5, 1119.2, 0.05, 0.00045, 5e-6},
                           {2e5, 1104.8, 0.05, 0.00105, 5e-6},
                           {4e5, 1076.3, 0.05, 0.00305, 5e-6},
                           {1e6, 990.76, 0.005, 0.0132, 5e-5}}) {
    EXPECT_NEAR(permittivity("skin", p.frequency_hz).real(), p.permittivity, p.half_digit) << p.frequency_hz;
    EXPECT_NEAR(conductivity("skin", p.frequency_hz), p.conductivity, p.half_digit_of_it) << p.frequency_hz;
  }
}

// Double Debye model of Liebe, Hufford & Manabe 1991, at 20 degrees Celsius: fitted to other data by others. The two differ by 4
// % at most up to 300 GHz.
TEST(Media, WaterAgreesWithAnotherModel) {
  const double theta = 300.0 / 293.15 - 1.0, e0 = 77.66 + 103.3 * theta, e1 = 0.0671 * e0, e2 = 3.52 - 7.52 * theta,
               g1 = 20.20 - 146.4 * theta + 316.0 * theta * theta, g2 = 39.8 * g1;
  for (const double f : {1.0, 10.0, 24.0, 77.0, 94.0, 300.0}) {
    const Complex other = e0 - f * ((e0 - e1) / Complex(f, -g1) + (e1 - e2) / Complex(f, -g2));
    EXPECT_LE(std::abs(permittivity("water", f * giga) - other), 0.04 * std::abs(other)) << f;
  }
}

// Depth to which a wave gets into copper at 10 GHz, sqrt(2 / (omega mu_0 sigma)): 0.65 um in every handbook.
TEST(Media, SkinDepthOfCopper) {
  const double depth = -1.0 / (wavenumber(10 * giga) * std::sqrt(permittivity("copper", 10 * giga)).imag());
  EXPECT_NEAR(depth, 0.652e-6, 0.001e-6);
}

// What docs/reference/media.md says of one medium, as text.
struct Row {
  std::string name;
  double lowest_ghz, highest_ghz;
  std::vector<std::string> permittivity;  // at 10, 24, 77 and 94 GHz
};

std::vector<Row> page() {
  std::ifstream in(RAYTUBE_SOURCE_DIR "/docs/reference/media.md");
  std::vector<Row> rows;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, '|');) cells.push_back(cell);
    const std::string& name = cells.at(1);
    rows.push_back(
        {name.substr(2, name.size() - 4), std::stod(cells.at(3)), std::stod(cells.at(4)), {&cells.at(5), &cells.at(9)}});
  }
  return rows;
}

TEST(Media, PageListsThemAll) {
  std::vector<std::string> names;
  for (const Row& row : page()) names.push_back(row.name);
  EXPECT_THAT(names, testing::ContainerEq(library_names()));
}

// Three digits are printed.
TEST(Media, PageHasTheirPermittivities) {
  constexpr std::array frequencies = {10.0, 24.0, 77.0, 94.0};
  for (const Row& row : page())
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const std::string& cell = row.permittivity.at(i);
      const double f = frequencies[i];
      EXPECT_EQ(cell.find('j') == std::string::npos, f < row.lowest_ghz || f > row.highest_ghz) << row.name << ' ' << f;
      if (cell.find('j') == std::string::npos) continue;
      const Complex printed(std::stod(cell), -std::stod(cell.substr(cell.find('j') + 1))),
          value = permittivity(row.name, f * giga);
      EXPECT_LE(std::abs(printed.real() - value.real()), 6e-3 * value.real()) << row.name << ' ' << f;
      EXPECT_LE(std::abs(printed.imag() - value.imag()), -6e-3 * value.imag() + 5e-4) << row.name << ' ' << f;
    }
}

// No gain anywhere, and no eps' below that of vacuum, in a hundred steps from end to end, both included.
TEST(Media, PassiveOverTheirRanges) {
  for (const Row& row : page()) {
    const double from = std::max(row.lowest_ghz, 1e-9);
    for (int i = 0; i <= 100; ++i) {
      const double ghz = i == 100 ? row.highest_ghz : from * std::pow(row.highest_ghz / from, 0.01 * i);
      const Medium medium = library_medium(row.name, ghz * giga).value();
      EXPECT_GE(medium.permittivity.real(), 1.0) << row.name << ' ' << ghz;
      EXPECT_LT(medium.permittivity.imag(), 0.0) << row.name << ' ' << ghz;
      EXPECT_EQ(medium.permeability, 1.0);
    }
  }
}

TEST(Media, RefusedBeyondTheirRanges) {
  for (const Row& row : page()) {
    EXPECT_THROW(library_medium(row.name, 1.001 * row.highest_ghz * giga), InputError) << row.name;
    if (row.lowest_ghz == 0.0) continue;
    EXPECT_THROW(library_medium(row.name, 0.999 * row.lowest_ghz * giga), InputError) << row.name;
  }
  try {
    library_medium("asphalt", 77 * giga);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "\"asphalt\" is known from 1 to 40 GHz, not at 77 GHz; give the permittivity in its place");
  }
}

}  // namespace
}  // namespace raytube
