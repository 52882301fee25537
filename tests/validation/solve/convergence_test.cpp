// The study of cases/convergence: orders that the geometry of tubes and edges asks for, errors that are what they are said to be.
#include "output/compare/convergence.h"

#include <gtest/gtest.h>

#include <regex>

#include "case/read_case.h"
#include "case/target.h"
#include "closed_forms.h"
#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;

struct Studied {
  Case c;
  std::vector<DensityResult> results;
  Convergence convergence;
};

Studied study(const std::string& name, const std::vector<double>& densities) {
  Studied studied{read_case(RAYTUBE_SOURCE_DIR "/cases/convergence/" + name), {}, {}};
  const Case& c = studied.c;
  const LoadedMesh loaded = load_target(c);
  const Target target(loaded.mesh, c.wedges);
  SolveOptions options{c.tubes, c.edges, 0, false, {}};
  for (const double density : densities) {
    options.tubes.per_wavelength = density;
    SweepResult result = solve(target, c.sweep, options);
    const Statistics& s = result.statistics;
    studied.results.push_back({density, s.tubes, s.rays, s.solve_s, std::move(result.total)});
  }
  studied.convergence = study_convergence(studied.results);
  return studied;
}

// True relative error of complex S against the closed form of the turned plate.
double true_error(const Studied& studied, std::size_t density) {
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < studied.c.sweep.looks.size(); ++i) {
    const Complex exact = closed_forms::plate(0.15, wavenumber(10e9), studied.c.sweep.looks[i].transmit, 33.0 * degree);
    error += std::norm(studied.results[density].total[i].vv() - exact);
    size += std::norm(exact);
  }
  return std::sqrt(error / size);
}

TEST(Converge, TurnedPlateHasTheOrderOfARandomStaircase) {
  // Errors of single cells along a straight edge are as good as independent: h per cell, 1/h cells, h^2 area each, so h^1.5. The
  // order from three densities scatters by about 0.4, the mean of three by half of that.
  const Studied plate = study("case.toml", {2, 4, 8, 16, 32});
  measured("plate turned 33 deg, mean order", plate.convergence.extrapolation->mean_order, "");
  EXPECT_NEAR(plate.convergence.extrapolation->mean_order, 1.5, 0.3);
}

TEST(Converge, TurnedPlateEstimatesAreTrue) {
  // Of one and the same size as the true error: coarse densities within a tenth, as the extrapolated value is much better than
  // they are; the finest, which rests on one order that scatters, within a factor of 4.
  const Studied plate = study("case.toml", {2, 4, 8, 16, 32});
  for (std::size_t i = 0; i < 5; ++i) {
    const double ratio = plate.convergence.densities[i].relative_error / true_error(plate, i);
    measured(("plate turned 33 deg, estimated / true error, density " + std::to_string(i)).c_str(), ratio, "");
    EXPECT_NEAR(std::log(ratio), 0.0, i < 3 ? 0.1 : std::log(4.0)) << i;
  }
  const Complex exact = closed_forms::plate(0.15, wavenumber(10e9), {0.0, 0.0});
  EXPECT_EQ(plate.convergence.strongest_row, 0u);
  EXPECT_LE(std::abs(plate.convergence.extrapolation->total[0].vv() - exact),
            plate.convergence.extrapolation->strongest_uncertainty);
}

TEST(Converge, DihedralHasFirstOrder) {
  // The border between the two beams runs along the grid's columns: all its cells err alike, by up to half a cell.
  const Studied dihedral = study("dihedral.toml", {2, 4, 8, 16, 32});
  measured("dihedral, mean order", dihedral.convergence.extrapolation->mean_order, "");
  EXPECT_NEAR(dihedral.convergence.extrapolation->mean_order, 1.0, 0.25);
}

// A line of the table in the README: density, tubes, rays, time, sigma, norm, change, relative change, order, error, rms.
std::map<std::string, std::vector<std::string>> table_in_readme(const std::string& command) {
  const std::string text = text_of(RAYTUBE_SOURCE_DIR "/cases/convergence/README.md");
  std::istringstream lines(text.substr(text.find(command)));
  std::map<std::string, std::vector<std::string>> table;
  for (std::string line; std::getline(lines, line) && !line.starts_with("    recommendation");) {
    std::istringstream in(line);
    const std::vector<std::string> cells{std::istream_iterator<std::string>(in), {}};
    if (cells.size() == 11 && std::isdigit(static_cast<unsigned char>(cells[0][0]))) table[cells[0]] = cells;
  }
  return table;
}

TEST(Converge, TheReadmeSaysWhatComesOut) {
  for (const std::string name : {"case.toml", "dihedral.toml"}) {
    auto table = table_in_readme("converge cases/convergence/" + name);
    ASSERT_EQ(table.size(), 6u) << name;
    const Studied small = study(name, {2, 4, 8, 16});
    for (std::size_t i = 0; i < 4; ++i) {
      const std::vector<std::string>& line = table[std::to_string(2 << i)];
      const DensityErrors& errors = small.convergence.densities[i];
      EXPECT_EQ(std::to_string(small.results[i].tubes), line[1]);
      EXPECT_NEAR(errors.norm, std::stod(line[5]), 1e-3 * errors.norm);
      if (i < 3) {
        EXPECT_NEAR(errors.change, std::stod(line[6]), 0.01 * errors.change);
      }
      if (i >= 2) {
        EXPECT_NEAR(errors.order, std::stod(line[8]), 0.01);
      }
    }
  }
}

}  // namespace
}  // namespace raytube
