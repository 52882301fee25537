// Model uncertainty against the true error: method of moments (tests/data/mom), spheres, and a target far below a wavelength.
#include <gtest/gtest.h>

#include "closed_forms.h"
#include "run.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

const std::string folder = RAYTUBE_SOURCE_DIR "/tests/data/mom/";

// 20 log10(1 + error / |S|) as in rcs.csv.
double level(const ScatteringMatrix& s, const ChannelErrors& error, int p, int q) {
  return 20.0 * std::log10(1.0 + error[p][q] / std::max(std::abs(s.at(p, q)), 0.01 * largest_amplitude(s)));
}

// Estimate over true error of every channel within 40 dB of the co-polar peak.
std::vector<double> ratios(const std::vector<ScatteringMatrix>& reference, const SweepResult& result) {
  double peak = 0.0;
  for (const ScatteringMatrix& s : reference) peak = std::max({peak, std::abs(s.vv()), std::abs(s.hh())});
  std::vector<double> found;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (const int c : {0, 1, 2, 3}) {
      const int p = c / 2, q = c % 2;
      if (std::abs(reference[i].at(p, q)) < 0.01 * peak) continue;
      const double error = std::abs(dbsm(result.total[i].at(p, q)) - dbsm(reference[i].at(p, q)));
      const double estimate =
          std::hypot(level(result.total[i], result.error[i], p, q), level(result.total[i], result.model[i], p, q));
      found.push_back(estimate / std::max(error, 1e-9));
    }
  return found;
}

std::vector<double> ratios_of_body(const std::string& body) {
  const Table table(folder + body + ".csv");
  const Target target(load_mesh(folder + body + ".stl", 1.0).mesh);
  std::map<std::string, std::vector<std::size_t>> cuts;
  for (std::size_t i = 0; i < table.rows(); ++i) cuts[table.text(i, "cut")].push_back(i);
  std::vector<double> found;
  for (const auto& [cut, rows] : cuts) {
    Sweep sweep{{10e9}, {}, cut.starts_with("bistatic")};
    std::vector<ScatteringMatrix> reference;
    for (const std::size_t i : rows) {
      sweep.looks.push_back({{table.number(i, "theta_i_deg") * degree, table.number(i, "phi_i_deg") * degree},
                             {table.number(i, "theta_deg") * degree, table.number(i, "phi_deg") * degree}});
      reference.push_back(
          {{{{table.complex(i, "vv"), table.complex(i, "vh")}, {table.complex(i, "hv"), table.complex(i, "hh")}}}});
    }
    const std::vector<double> here = ratios(reference, solve(target, sweep));
    found.insert(found.end(), here.begin(), here.end());
  }
  return found;
}

TEST(ModelUncertainty, CoversTheErrorOfSmallBodies) {
  // Asked: 85 % covered, and not by being useless: a median ratio of 6.
  for (const std::string body : {"cube2", "plate3", "dihedral3"}) {
    const std::vector<double> found = ratios_of_body(body);
    const auto covered = static_cast<double>(std::ranges::count_if(found, [](double ratio) { return ratio >= 1.0; }));
    measured(("model uncertainty, " + body + ", covered").c_str(), 100.0 * covered / static_cast<double>(found.size()), "%");
    measured(("model uncertainty, " + body + ", median ratio").c_str(), quantile(found, 0.5), "");
    EXPECT_GE(covered, 0.85 * static_cast<double>(found.size())) << body;
    EXPECT_LE(quantile(found, 0.5), 6.0) << body;
  }
}

TEST(ModelUncertainty, CoversTheErrorOfSpheres) {
  const Target target(build_mesh(shapes::icosphere(4), 1.0).mesh);
  int covered = 0;
  double largest = 0.0;
  const std::vector<double> sizes = {5, 6, 7, 8, 10, 12, 14, 17, 20, 24, 29, 34, 41, 50};
  for (const double ka : sizes) {
    const SweepResult result = solve(target, monostatic({{1.2, 0.3}}, ka * speed_of_light / (2.0 * pi)));
    const double error = std::abs(dbsm(result.total[0].vv()) - dbsm(closed_forms::sphere(1.0, ka, 0.0).second));
    const double estimate = level(result.total[0], result.model[0], 0, 0);
    covered += error <= estimate ? 1 : 0;
    largest = std::max(largest, estimate);
  }
  measured("model uncertainty, 14 spheres of ka 5 to 50, covered", covered, "");
  measured("model uncertainty, same, largest", largest, "dB");
  EXPECT_GE(covered, 12);   // 85 %
  EXPECT_LE(largest, 3.0);  // creeping waves at ka = 5 are 1 dB and more
}

TEST(ModelUncertainty, TrihedralOfAHundredthOfAWavelengthIsWorthless) {
  const SweepResult result =
      solve(Target(build_mesh(shapes::trihedral(0.15), 1.0).mesh), monostatic({{54.7 * degree, 45.0 * degree}}, 10e6));
  const double estimate = level(result.total[0], result.model[0], 0, 0);
  measured("model uncertainty, trihedral of 150 mm at 10 MHz", estimate, "dB");
  EXPECT_GE(estimate, 20.0);
  ASSERT_FALSE(result.model_parts.empty());
}

TEST(ModelUncertainty, LooksThatFollowFromOthersHaveTheSame) {
  // All mirror images of one look of a plate, with one of them repeated a turn later.
  std::vector<Direction> looks;
  for (const double phi : {20.0, 160.0, 200.0, 340.0, 380.0}) looks.push_back({50.0 * degree, phi * degree});
  const SweepResult result = solve(Target(build_mesh(shapes::plate(1.0), 1.0).mesh), monostatic(looks, 1e9));
  for (const ChannelErrors& model : result.model) EXPECT_EQ(model, result.model[0]);
  EXPECT_GT(result.model[0][0][0], 0.0);
  double share = 0.0;
  std::uint64_t rows = 0;
  for (const ModelPart& part : result.model_parts) share += part.share, rows += part.rows_largest;
  EXPECT_NEAR(share, 1.0, 1e-12);
  EXPECT_EQ(rows, looks.size());
}

TEST(ModelUncertainty, KnowsWhichMechanismsAreOff) {
  const Target target(build_mesh(shapes::dihedral(0.1, 0.1), 1.0).mesh);
  std::vector<Direction> looks;
  for (const double phi : {35.0, 40.0, 45.0, 50.0}) looks.push_back({90.0 * degree, phi * degree});  // into the corner
  const auto rms_of = [&](const std::string& name, auto change) {
    SolveOptions o;
    change(o.edges);
    const SweepResult result = solve(target, monostatic(looks, 10e9), o);
    const auto part = std::ranges::find(result.model_parts, name, &ModelPart::name);
    return part == result.model_parts.end() ? 0.0 : part->rms;
  };
  const auto nothing = [](EdgeOptions&) {};
  const double interaction = rms_of("interaction", nothing);
  EXPECT_GT(interaction, 0.0);
  EXPECT_GT(rms_of("interaction", [](EdgeOptions& edges) { edges.interaction = false; }), interaction);
  EXPECT_EQ(rms_of("edges", nothing), 0.0);
  EXPECT_GT(rms_of("edges", [](EdgeOptions& edges) { edges.method = EdgeMethod::none; }), 0.0);
  EXPECT_GT(rms_of("corners", [](EdgeOptions& edges) { edges.order = 1; }), rms_of("corners", nothing));
}

}  // namespace
}  // namespace raytube
