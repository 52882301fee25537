// Tables: columns, order, numbers.
#include "output/tables/csv.h"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>
#include <utility>

#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::StartsWith;

// Two looks at two frequencies; the value of a channel tells its row and place.
Sweep small_sweep(bool bistatic) {
  const Look first{{90 * degree, 0.1 * degree}, {90 * degree, 0.1 * degree}};
  const Look second{{27 * degree, -3 * degree}, {bistatic ? 45 * degree : 27 * degree, -3 * degree}};
  return {{1e9, 9.4e9}, {first, second}, bistatic};
}

ScatteringMatrix matrix(double base) {
  return {{{{Complex{base, 0.25}, Complex{-0.0, 0.0}}, {Complex{0.0, -base}, Complex{-base, -0.0}}}}};
}

std::vector<MechanismRows> mechanisms(std::size_t rows) {
  std::vector<MechanismRows> columns;
  for (const char* name : {"edges_order_1", "edges_order_2_on", "interaction", "surface_waves"})
    columns.push_back({name, std::vector<ScatteringMatrix>(rows)});
  return columns;
}

SweepResult small_result(const Sweep& sweep) {
  SweepResult result;
  for (std::size_t row = 0; row < sweep.rows(); ++row) result.total.push_back(matrix(static_cast<double>(row + 1)));
  result.error.assign(sweep.rows(), {{{0.01, 0.002}, {0.0, 0.5}}});
  result.model.assign(sweep.rows(), {{{0.5, 0.0}, {0.004, 0.02}}});
  result.bounces = {result.total, std::vector<ScatteringMatrix>(sweep.rows())};
  result.mechanisms = mechanisms(sweep.rows());
  return result;
}

std::string header_of(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  while (std::getline(in, line) && line[0] == '#') {
  }
  return line;
}

TEST(OutputCsv, RcsHasTheColumnsAndStatesTheConventions) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(false);
  write_rcs_csv(scratch / "rcs.csv", sweep, small_result(sweep));
  const std::string text = text_of(scratch / "rcs.csv");
  EXPECT_EQ(header_of(text),
            "freq_hz,theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,re_vv,im_vv,re_vh,im_vh,re_hv,im_hv,re_hh,im_hh,"
            "sigma_vv_dbsm,sigma_vh_dbsm,sigma_hv_dbsm,sigma_hh_dbsm,"
            "err_vv_db,err_vh_db,err_hv_db,err_hh_db,"
            "model_vv_db,model_vh_db,model_hv_db,model_hh_db");
  for (const char* word : {"exp(+j omega t)", "origin", "4 pi |S_pq|^2", "theta-hat", "dBsm"})
    EXPECT_NE(text.find(word), std::string::npos) << word;
}

TEST(OutputCsv, RcsRowsLooksSlowestFrequencyFastest) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(true);
  write_rcs_csv(scratch / "rcs.csv", sweep, small_result(sweep));
  const Table table((scratch / "rcs.csv").string());
  ASSERT_EQ(table.rows(), 4u);
  EXPECT_EQ(table.text(1, "freq_hz"), "9400000000");
  EXPECT_EQ(table.text(1, "phi_deg"), "0.1");
  EXPECT_EQ(table.text(2, "theta_deg"), "27");
  EXPECT_EQ(table.text(2, "rx_theta_deg"), "45");
  EXPECT_EQ(table.text(2, "phi_deg"), "-3");
  for (std::size_t row = 0; row < 4; ++row) EXPECT_EQ(table.complex(row, "vv"), Complex(static_cast<double>(row + 1), 0.25));
}

TEST(OutputCsv, ZeroIsMinusInfinityAndNeverMinusZero) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(false);
  write_rcs_csv(scratch / "rcs.csv", sweep, small_result(sweep));
  const Table table((scratch / "rcs.csv").string());
  EXPECT_EQ(table.text(0, "re_vh"), "0");
  EXPECT_EQ(table.text(0, "im_hh"), "0");
  EXPECT_EQ(table.text(0, "sigma_vh_dbsm"), "-inf");
  EXPECT_NEAR(table.number(0, "sigma_hh_dbsm"), 10.0 * std::log10(4.0 * pi), 1e-12);
}

// A weak channel's error is held against a hundredth of the row's largest amplitude.
TEST(OutputCsv, ErrorsAreLevelsAboveTheAmplitude) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(false);
  const SweepResult result = small_result(sweep);
  write_rcs_csv(scratch / "rcs.csv", sweep, result);
  const Table table((scratch / "rcs.csv").string());
  const ScatteringMatrix& s = result.total[2];
  constexpr double rounding = 1e-12;  // of 1 + small, in the plain form here
  const auto level = [](double error, double amplitude) { return 20.0 * std::log10(1.0 + error / amplitude); };
  EXPECT_NEAR(table.number(2, "err_vv_db"), level(0.01, std::abs(s.vv())), rounding);
  EXPECT_NEAR(table.number(2, "err_vh_db"), level(0.002, 0.01 * largest_amplitude(s)), rounding);
  EXPECT_EQ(table.number(2, "err_hv_db"), 0.0);
  EXPECT_NEAR(table.number(2, "err_hh_db"), level(0.5, std::abs(s.hh())), rounding);
  EXPECT_NEAR(table.number(2, "model_vv_db"), level(0.5, std::abs(s.vv())), rounding);
  EXPECT_EQ(table.number(2, "model_vh_db"), 0.0);
  EXPECT_NEAR(table.number(2, "model_hh_db"), level(0.02, std::abs(s.hh())), rounding);
}

TEST(OutputCsv, SigmaDoesNotUnderflow) {
  EXPECT_NEAR(sigma_dbsm({1e-200, 0.0}), -4000.0 + 10.0 * std::log10(4.0 * pi), 1e-9);
  EXPECT_NEAR(sigma_dbsm({3e200, 4e200}), 20.0 * std::log10(5.0) + 4000.0 + 10.0 * std::log10(4.0 * pi), 1e-9);
  EXPECT_EQ(sigma_dbsm(0.0), -std::numeric_limits<double>::infinity());
}

TEST(OutputCsv, ChannelsHoldMagnitudeAndPhase) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(false);
  write_channels_csv(scratch / "channels.csv", sweep, small_result(sweep));
  EXPECT_THAT(text_of(scratch / "channels.csv"),
              StartsWith("freq_hz,theta_deg,phi_deg,tx_pol,v_magnitude,v_phase_rad,h_magnitude,h_phase_rad\n"));
  const Table table((scratch / "channels.csv").string());
  ASSERT_EQ(table.rows(), 8u);
  EXPECT_EQ(table.text(2, "tx_pol"), "v");
  EXPECT_DOUBLE_EQ(table.number(2, "v_magnitude"), std::sqrt(4.0 * pi) * std::hypot(2.0, 0.25));
  EXPECT_DOUBLE_EQ(table.number(2, "v_phase_rad"), std::atan2(0.25, 2.0));
  EXPECT_DOUBLE_EQ(table.number(2, "h_phase_rad"), -pi / 2);
  EXPECT_EQ(table.text(3, "tx_pol"), "h");
  EXPECT_EQ(table.text(3, "v_magnitude"), "0");
  EXPECT_EQ(table.text(3, "v_phase_rad"), "0");
  EXPECT_DOUBLE_EQ(table.number(3, "h_magnitude"), std::sqrt(4.0 * pi) * 2.0);
  EXPECT_DOUBLE_EQ(table.number(3, "h_phase_rad"), pi);  // not -pi, though the imaginary part is -0
}

TEST(OutputCsv, BistaticChannelsCarryTheReceiver) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(true);
  write_channels_csv(scratch / "channels.csv", sweep, small_result(sweep));
  const Table table((scratch / "channels.csv").string());
  EXPECT_EQ(table.text(4, "rx_theta_deg"), "45");
  EXPECT_EQ(table.text(4, "rx_phi_deg"), "-3");
}

// Nothing that reads the other columns finds them elsewhere.
TEST(OutputCsv, TimesAreTheLastColumnOfEveryTable) {
  const Scratch scratch;
  Sweep sweep = small_sweep(true);
  SweepResult result = small_result(sweep);
  result.incoherent.assign(sweep.rows(), {0.5, 0.25});
  const auto written = [&](const std::string& name) {
    const auto file = scratch / name;
    if (name == "rcs.csv") write_rcs_csv(file, sweep, result);
    if (name == "channels.csv") write_channels_csv(file, sweep, result);
    if (name == "parts.csv") write_parts_csv(file, sweep, result);
    if (name == "incoherent.csv") write_incoherent_csv(file, sweep, result);
    return text_of(file);
  };
  for (const std::string name : {"rcs.csv", "channels.csv", "parts.csv", "incoherent.csv"}) {
    sweep.times = {};
    std::istringstream rest(written(name));
    sweep.times = {0.0, 1.25e-4};
    std::istringstream moving(written(name));
    const std::size_t lines_of_a_look = name == "channels.csv" ? 4 : 2;
    std::size_t row = 0;
    bool below_header = false;
    for (std::string a, b; std::getline(rest, a) && std::getline(moving, b);) {
      if (a.starts_with('#'))
        EXPECT_EQ(b, a);
      else if (!std::exchange(below_header, true))
        EXPECT_EQ(b, a + ",time_s");
      else
        EXPECT_EQ(b, a + (row++ < lines_of_a_look ? ",0" : ",0.000125"));
    }
    EXPECT_EQ(row, 2 * lines_of_a_look) << name;
  }
}

TEST(OutputCsv, PartsAddUpToTheTotal) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(false);
  SweepResult result = small_result(sweep);
  result.mechanisms[0].rows[3] = matrix(0.125);
  result.mechanisms[1].rows[3] = matrix(0.5);
  result.mechanisms[2].rows[2] = matrix(0.25);
  result.mechanisms[3].rows[3] = matrix(0.0625);
  for (const std::size_t column : {0, 1, 3}) result.total[3] += result.mechanisms[column].rows[3];
  result.total[2] += result.mechanisms[2].rows[2];
  write_parts_csv(scratch / "parts.csv", sweep, result);
  const Table table((scratch / "parts.csv").string());
  ASSERT_EQ(table.rows(), 4u);
  EXPECT_EQ(table.text(3, "theta_deg"), "27");
  for (const std::string channel : {"vv", "vh", "hv", "hh"}) {
    Complex sum = 0.0;
    for (const std::string part : {"_bounce_1", "_bounce_2", "_edges_order_1", "_edges_order_2_on", "_surface_waves"})
      sum += table.complex(3, channel + part);
    EXPECT_EQ(sum, result.total[3].at(channel[0] == 'h', channel[1] == 'h')) << channel;
  }
}

TEST(OutputCsv, PartsEndWithThoseOfTheModelUncertainty) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(false);
  SweepResult result = small_result(sweep);
  result.model_parts.push_back({"corners", "", "", 0.1, 1.0, 4, result.model});
  write_parts_csv(scratch / "parts.csv", sweep, result);
  EXPECT_THAT(header_of(text_of(scratch / "parts.csv")),
              ::testing::EndsWith(",model_corners_vv_m,model_corners_vh_m,model_corners_hv_m,model_corners_hh_m"));
  const Table table((scratch / "parts.csv").string());
  EXPECT_EQ(table.number(3, "model_corners_vv_m"), 0.5);
  EXPECT_EQ(table.number(3, "model_corners_hv_m"), 0.004);
}

TEST(OutputCsv, PartsStateTheConventionsAndKeepTheirColumnsWhereNothingIsHit) {
  const Scratch scratch;
  const Sweep sweep = small_sweep(false);
  SweepResult nothing;
  nothing.total.resize(sweep.rows());
  nothing.error.resize(sweep.rows());
  nothing.model.resize(sweep.rows());
  nothing.mechanisms = mechanisms(sweep.rows());
  write_parts_csv(scratch / "parts.csv", sweep, nothing);
  write_rcs_csv(scratch / "rcs.csv", sweep, nothing);
  const std::string parts = text_of(scratch / "parts.csv"), rcs = text_of(scratch / "rcs.csv");
  EXPECT_THAT(parts, StartsWith(rcs.substr(0, rcs.find("\nfreq_hz") + 1)));
  const Table table((scratch / "parts.csv").string());
  ASSERT_EQ(table.rows(), 4u);
  EXPECT_EQ(table.complex(2, "hh_bounce_1"), Complex(0.0));
  EXPECT_EQ(table.complex(2, "hh_edges_order_1"), Complex(0.0));
}

}  // namespace
}  // namespace raytube
