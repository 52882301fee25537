// Short ways to solve a test target and to compare results.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "solve/solve.h"

namespace raytube::testing {

inline Sweep monostatic(const std::vector<Direction>& directions, double frequency_hz) {
  Sweep sweep{{frequency_hz}, {}, false};
  for (const Direction& d : directions) sweep.looks.push_back({d, d});
  return sweep;
}

inline SolveOptions options(EdgeMethod edges, double per_wavelength = 10.0) {
  SolveOptions o;
  o.edges.method = edges;
  o.tubes.mode = TubeMode::uniform;
  o.tubes.per_wavelength = o.tubes.max_per_wavelength = per_wavelength;
  o.keep_parts = true;
  return o;
}

inline SweepResult solve_soup(PolygonSoup soup, const Sweep& sweep, const SolveOptions& o, const WedgeOptions& wedges = {}) {
  return solve(Target(build_mesh(std::move(soup), 1.0).mesh, wedges), sweep, o);
}

/// Prints a measured figure among the test's output; docs/theory/accuracy.md says how to collect them.
inline void measured(const char* what, double value, const char* unit) {
  std::printf("measured: %s = %.5g %s\n", what, value, unit);
}

/// Half a unit of the last digit of a figure as printed: ".0094" or "2.3e-2".
inline double half_unit(const std::string& printed) {
  const std::string digits = printed.substr(0, printed.find('e'));
  const double exponent = digits.size() == printed.size() ? 0.0 : std::stod(printed.substr(digits.size() + 1));
  const std::size_t point = digits.find('.');
  const double decimals = point == std::string::npos ? 0.0 : static_cast<double>(digits.size() - 1 - point);
  return 0.5 * std::pow(10.0, exponent - decimals);
}

/// Expects a figure that another program has printed, to the digits it has.
inline void expect_printed(double found, const std::string& printed, const std::string& what) {
  std::printf("measured: %s: %.5g, printed %s\n", what.c_str(), found, printed.c_str());
  EXPECT_NEAR(found, std::stod(printed), half_unit(printed)) << what;
}

inline double dbsm(Complex s) { return 20.0 * std::log10(std::abs(s)) + 10.0 * std::log10(4.0 * pi); }

inline double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  return values.at(static_cast<std::size_t>(q * static_cast<double>(values.size() - 1)));
}

inline double rms(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / static_cast<double>(values.size()));
}

/// A CSV file with a header line; '#' lines are skipped, text cells are kept as text.
class Table {
 public:
  explicit Table(const std::string& path) {
    std::ifstream in(path);
    if (!in) throw std::runtime_error("cannot open " + path);
    std::string line;
    while (std::getline(in, line)) {
      if (line.empty() || line[0] == '#') continue;
      std::vector<std::string> cells;
      std::stringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      if (columns_.empty())
        for (std::size_t i = 0; i < cells.size(); ++i) columns_[cells[i]] = i;
      else
        rows_.push_back(cells);
    }
  }
  std::size_t rows() const { return rows_.size(); }
  const std::string& text(std::size_t row, const std::string& column) const { return rows_.at(row).at(columns_.at(column)); }
  double number(std::size_t row, const std::string& column) const { return std::stod(text(row, column)); }
  Complex complex(std::size_t row, const std::string& channel) const {
    return {number(row, "re_" + channel), number(row, "im_" + channel)};
  }

 private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace raytube::testing
