// Results as netCDF files and as tables: there and back, bit for bit.
#include <gmock/gmock.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "core/error.h"
#include "output/compare/density_results.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/csv.h"
#include "output/tables/result_table.h"
#include "output/tables/stored.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// A NaN that carries bits of its own, as no computation makes it.
const double marked_nan = std::bit_cast<double>(0x7ff8000000abcdefULL);

template <typename Rows>
std::vector<std::uint64_t> bits(const Rows& rows) {
  std::vector<std::uint64_t> all(rows.size() * sizeof(rows.front()) / sizeof(std::uint64_t));
  std::memcpy(all.data(), rows.data(), all.size() * sizeof(std::uint64_t));
  return all;
}

ScatteringMatrix matrix(double base) {
  return {{{{Complex{base, -0.0}, Complex{-0.0, marked_nan}}, {Complex{5e-324, -base}, Complex{1.0 / 3.0, -infinite}}}}};
}

ChannelErrors level(double base) { return {{{base, -infinite}, {marked_nan, -0.0}}}; }

/// Two looks at three frequencies with everything a file can hold; no two numbers that could be mixed up are alike.
StoredResult full_result() {
  StoredResult result;
  result.frequency_hz = {1e9, 9.4e9, 10.000000000000002e9};
  result.looks = {{90, 0.1, 45, -3, 5.0, 7.5}, {27, -3, 27, 1e-300, 0.1, 1e5}};
  result.bistatic = true;
  for (int row = 0; row < 6; ++row) {
    const double base = row + 1;
    result.s.push_back(matrix(base));
    result.sigma_dbsm.push_back(level(base + 10));
    result.err_db.push_back(level(base + 20));
    result.model_db.push_back(level(base + 30));
    result.error_m.push_back(level(base + 40));
    result.model_m.push_back(level(base + 50));
    result.incoherent_m2.push_back({base, -0.0});
  }
  for (const char* name : {"bounce_1", "edges_order_1"})
    result.parts.push_back({name, std::vector(6, matrix(60.0 + static_cast<double>(result.parts.size())))});
  for (const char* name : {"facets", "at"})
    result.model_parts.push_back({name, std::vector(6, level(70.0 + static_cast<double>(result.model_parts.size())))});
  result.comment = "# one\n# two\n";
  result.attributes = {{"title", "a wing, 3 \xCE\xBB"}, {"case", "{\n  \"a\": 1\n}"}};
  return result;
}

void expect_equal(const StoredResult& a, const StoredResult& b) {
  EXPECT_EQ(bits(a.frequency_hz), bits(b.frequency_hz));
  EXPECT_EQ(bits(a.looks), bits(b.looks));
  EXPECT_EQ(a.bistatic, b.bistatic);
  EXPECT_EQ(a.moving, b.moving);
  EXPECT_EQ(bits(a.s), bits(b.s));
  for (const auto rows : {&StoredResult::sigma_dbsm, &StoredResult::err_db, &StoredResult::model_db, &StoredResult::error_m,
                          &StoredResult::model_m})
    EXPECT_EQ(bits(a.*rows), bits(b.*rows));
  EXPECT_EQ(bits(a.incoherent_m2), bits(b.incoherent_m2));
  ASSERT_EQ(a.parts.size(), b.parts.size());
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    EXPECT_EQ(a.parts[i].name, b.parts[i].name);
    EXPECT_EQ(bits(a.parts[i].s), bits(b.parts[i].s));
  }
  ASSERT_EQ(a.model_parts.size(), b.model_parts.size());
  for (std::size_t i = 0; i < a.model_parts.size(); ++i) {
    EXPECT_EQ(a.model_parts[i].name, b.model_parts[i].name);
    EXPECT_EQ(bits(a.model_parts[i].m), bits(b.model_parts[i].m));
  }
  EXPECT_EQ(a.comment, b.comment);
  EXPECT_EQ(a.attributes, b.attributes);
}

std::string refusal(const auto& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OutputNetcdf, EverythingComesBackBitForBit) {
  const Scratch scratch;
  write_netcdf(scratch / "a.nc", full_result());
  expect_equal(read_netcdf(scratch / "a.nc"), full_result());
}

TEST(OutputNetcdf, WhatIsNotKnownIsNotThere) {
  const Scratch scratch;
  StoredResult result = full_result();
  result.error_m = result.model_m = {};
  result.parts = {};
  result.model_parts = {};
  result.incoherent_m2 = {};
  result.attributes = {};
  for (StoredLook& look : result.looks) look.range_m = look.rx_range_m = infinite;
  write_netcdf(scratch / "a.nc", result);
  expect_equal(read_netcdf(scratch / "a.nc"), result);
}

StoredResult moving_result() {
  StoredResult result = full_result();
  result.moving = true;
  for (std::size_t i = 0; i < result.looks.size(); ++i) result.looks[i].time_s = -0.1 + 1e-4 * static_cast<double>(i);
  return result;
}

TEST(OutputNetcdf, TimesOfLooksComeBack) {
  const Scratch scratch;
  write_netcdf(scratch / "a.nc", moving_result());
  expect_equal(read_netcdf(scratch / "a.nc"), moving_result());
  EXPECT_EQ(stored_sweep(sweep_of(moving_result())).looks.back().time_s, moving_result().looks.back().time_s);
}

// Looks that differ in time alone stay apart, and are found again.
TEST(OutputStored, ATableOfTimesComesBack) {
  const Scratch scratch;
  StoredResult result = moving_result();
  result.looks[1] = {result.looks[0].theta_deg,  result.looks[0].phi_deg, result.looks[0].rx_theta_deg,
                     result.looks[0].rx_phi_deg, result.looks[0].range_m, result.looks[0].rx_range_m,
                     result.looks[1].time_s};
  write_rcs_csv(scratch / "a.csv", result);
  const StoredResult back = read_rcs_csv(scratch / "a.csv");
  EXPECT_TRUE(back.moving);
  EXPECT_EQ(back.looks, result.looks);
  write_rcs_csv(scratch / "b.csv", back);
  EXPECT_EQ(text_of(scratch / "b.csv"), text_of(scratch / "a.csv"));
}

// Files of HDF5 may hold the second in which they were made.
TEST(OutputNetcdf, EqualResultsGiveEqualBytesAtAnyTime) {
  const Scratch scratch;
  write_netcdf(scratch / "a.nc", full_result());
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_netcdf(scratch / "b.nc", full_result());
  EXPECT_TRUE(text_of(scratch / "a.nc") == text_of(scratch / "b.nc"));
}

// HDF5 takes no attribute of 64 kB; a case with many angles is larger.
TEST(OutputNetcdf, AttributesMayBeLong) {
  const Scratch scratch;
  for (const std::size_t length : {59'999, 60'000, 60'001, 65'536}) {
    StoredResult near_the_limit = full_result();
    near_the_limit.attributes.emplace_back("long", std::string(length, 'x'));
    write_netcdf(scratch / "a.nc", near_the_limit);
    expect_equal(read_netcdf(scratch / "a.nc"), near_the_limit);
  }
  StoredResult result = full_result();
  result.attributes.emplace_back("long", std::string(3'000'000, 'x') + 'y');
  write_netcdf(scratch / "a.nc", result);
  expect_equal(read_netcdf(scratch / "a.nc"), result);
}

TEST(OutputNetcdf, WhatCannotBeWrittenIsToldAndLeavesNoFile) {
  const Scratch scratch;
  EXPECT_THROW(write_netcdf(scratch / "missing/a.nc", full_result()), std::runtime_error);
  StoredResult result = full_result();
  result.attributes.emplace_back("no/name", "of an attribute");
  EXPECT_THROW(write_netcdf(scratch / "a.nc", result), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.nc"));
}

TEST(OutputNetcdf, OtherFilesAreRefused) {
  const Scratch scratch;
  const auto says = [&](const std::string& name) { return refusal([&] { read_netcdf(scratch / name); }); };
  EXPECT_THAT(says("missing.nc"), HasSubstr("missing.nc: cannot be read; give the path of a netCDF file"));
  scratch.write("text.nc", "freq_hz,theta_deg\n");
  EXPECT_THAT(says("text.nc"), HasSubstr("text.nc: cannot be read ("));
  write_netcdf(scratch / "a.nc", full_result());
  const std::string bytes = text_of(scratch / "a.nc");
  scratch.write("cut.nc", bytes.substr(0, bytes.size() / 8));
  EXPECT_THAT(says("cut.nc"), HasSubstr("give a netCDF file that raytube run or raytube convert has written"));
  // An empty file of the older format, which netCDF opens, too: magic number, no records, dimensions, attributes, variables.
  scratch.write("empty.nc", std::string("CDF\1", 4) + std::string(28, '\0'));
  EXPECT_THAT(says("empty.nc"), HasSubstr("empty.nc: holds no variable S_re; give a netCDF file"));
}

// Rows are told apart by them, and a table with such a cell is refused, too.
TEST(OutputNetcdf, AxesMustBeNumbers) {
  const Scratch scratch;
  const auto says = [&](const auto& change) {
    StoredResult result = full_result();
    change(result);
    write_netcdf(scratch / "a.nc", result);
    return refusal([&] { read_netcdf(scratch / "a.nc"); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(says([](StoredResult& r) { r.looks.back().phi_deg = nan; }), HasSubstr("a.nc: phi_deg holds something that is no"));
  EXPECT_THAT(says([](StoredResult& r) { r.frequency_hz.back() = nan; }), HasSubstr("a.nc: frequency holds something"));
  EXPECT_THAT(says([](StoredResult& r) { r.frequency_hz.back() = 0.0; }), HasSubstr("frequency that is not greater than 0"));
}

/// Two looks at two frequencies, far or near, as a solve gives them.
struct Solved {
  Sweep sweep{{1e9, 9.4e9}, {}, false};
  SweepResult result;

  explicit Solved(double range = infinite) {
    const Direction directions[] = {{90 * degree, 0.1 * degree}, {27 * degree, -3 * degree}};
    for (const Direction& d : directions) sweep.looks.push_back({d, d, range, range});
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
      const double base = static_cast<double>(row) + 1.0 / 3.0;
      result.total.push_back({{{{Complex{base, 0.25}, Complex{-0.0, 0.0}}, {Complex{0.0, -base}, Complex{-base, -0.0}}}}});
    }
    result.error.assign(sweep.rows(), {{{0.01, 0.002}, {0.0, 0.5}}});
    result.model.assign(sweep.rows(), {{{0.5, 0.0}, {0.004, 0.02}}});
  }
};

TEST(OutputStored, ATableOfAStoredResultHasTheBytesOfTheSolves) {
  const Scratch scratch;
  for (const double range : {infinite, 5.5}) {
    const Solved solved(range);
    write_rcs_csv(scratch / "solve.csv", solved.sweep, solved.result, "# a note\n");
    write_rcs_csv(scratch / "stored.csv", stored(solved.sweep, solved.result, "# a note\n"));
    EXPECT_EQ(text_of(scratch / "stored.csv"), text_of(scratch / "solve.csv"));
  }
}

// By way of netCDF: zero sigma, the comment lines and ranges are the same bytes again.
TEST(OutputStored, ATableComesBackFromNetcdfByteForByte) {
  const Scratch scratch;
  for (const double range : {infinite, 5.5}) {
    const Solved solved(range);
    write_rcs_csv(scratch / "a.csv", solved.sweep, solved.result, "# a note\n");
    ASSERT_THAT(text_of(scratch / "a.csv"), HasSubstr(",-inf,"));
    write_netcdf(scratch / "a.nc", read_rcs_csv(scratch / "a.csv"));
    write_rcs_csv(scratch / "b.csv", read_netcdf(scratch / "a.nc"));
    EXPECT_EQ(text_of(scratch / "b.csv"), text_of(scratch / "a.csv"));
  }
}

TEST(OutputStored, ATableOfUnusableNumbersComesBack) {
  const Scratch scratch;
  Solved solved;
  solved.result.total[1].at(0, 0) = {std::nan(""), infinite};
  write_rcs_csv(scratch / "a.csv", solved.sweep, solved.result);
  ASSERT_THAT(text_of(scratch / "a.csv"), HasSubstr("nan,inf,"));
  write_rcs_csv(scratch / "b.csv", read_rcs_csv(scratch / "a.csv"));
  EXPECT_EQ(text_of(scratch / "b.csv"), text_of(scratch / "a.csv"));
}

// A list of looks may name one twice.
TEST(OutputStored, TheSameLookTwiceStaysTwoLooks) {
  const Scratch scratch;
  Solved solved;
  solved.sweep.looks[1] = solved.sweep.looks[0];
  write_rcs_csv(scratch / "a.csv", solved.sweep, solved.result);
  const StoredResult read = read_rcs_csv(scratch / "a.csv");
  EXPECT_EQ(read.looks.size(), 2u);
  EXPECT_EQ(read.frequency_hz.size(), 2u);
}

TEST(OutputStored, RowsThatAreNoGridAreRefusedWithTheirLine) {
  const Scratch scratch;
  const Solved solved;
  write_rcs_csv(scratch / "a.csv", solved.sweep, solved.result);
  const std::string text = text_of(scratch / "a.csv");
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1, before = text.rfind('\n', last - 2) + 1;
  const auto says = [&](const std::string& changed) {
    scratch.write("b.csv", changed);
    return refusal([&] { read_rcs_csv(scratch / "b.csv"); });
  };
  EXPECT_THAT(says(text.substr(0, last)), HasSubstr("b.csv, line 11: rows are not every look at every frequency"));
  EXPECT_THAT(says(text.substr(0, before) + text.substr(last) + text.substr(before, last - before)),
              HasSubstr("b.csv, line 11: rows are not every look at every frequency"));
  EXPECT_THAT(says(text.substr(0, text.find("\n10000") + 1)), HasSubstr("no rows below the header"));
  EXPECT_THAT(says("freq_hz,theta_deg\n1,2\n"), HasSubstr("its columns are not those of rcs.csv"));
}

TEST(OutputStored, CompareTakesTheSameRowsFromBoth) {
  const Scratch scratch;
  const Solved solved;
  write_rcs_csv(scratch / "a.csv", solved.sweep, solved.result);
  write_netcdf(scratch / "a.nc", stored(solved.sweep, solved.result));
  const ResultTable table = read_result_table(scratch / "a.csv"), netcdf = read_result_table(scratch / "a.nc");
  ASSERT_EQ(netcdf.rows.size(), table.rows.size());
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    EXPECT_EQ(netcdf.rows[row].key, table.rows[row].key);
    EXPECT_EQ(netcdf.rows[row].s, table.rows[row].s);
    EXPECT_EQ(netcdf.rows[row].sigma_dbsm, table.rows[row].sigma_dbsm);
  }
  EXPECT_EQ(netcdf.has_key, table.has_key);
  EXPECT_EQ(netcdf.has_phase, table.has_phase);
  EXPECT_EQ(netcdf.has_level, table.has_level);
}

ResultFile at_density(double density, const std::string& more = "\"max_bounces\": 8") {
  const Solved solved;
  ResultFile file{"n" + std::to_string(static_cast<int>(density)) + ".nc", stored(solved.sweep, solved.result)};
  file.result.attributes = {
      {"case", "{\"target\": {\"mesh\": \"a.off\"}, \"tubes\": {\"mode\": \"uniform\", \"per_wavelength\": " +
                   std::to_string(density) + ", " + more + "}}"},
      {"counts", "{\"tubes\": 3, \"rays\": 7}"},
      {"mesh_sha256", "abc"}};
  return file;
}

TEST(DensityResults, AreSortedByTheDensityInTheirCases) {
  const std::vector<DensityResult> results = density_results({at_density(8), at_density(2), at_density(4.5)});
  ASSERT_EQ(results.size(), 3u);
  EXPECT_EQ(results[0].per_wavelength, 2.0);
  EXPECT_EQ(results[1].per_wavelength, 4.5);
  EXPECT_EQ(results[2].per_wavelength, 8.0);
  EXPECT_EQ(results[0].rays, 7u);
  EXPECT_TRUE(std::isnan(results[0].solve_s));
}

TEST(DensityResults, WhatDoesNotGoTogetherIsRefused) {
  const auto says = [](ResultFile changed) {
    return refusal([&] { density_results({at_density(2), at_density(4), std::move(changed)}); });
  };
  EXPECT_EQ(says(at_density(8)), "");
  EXPECT_THAT(says(at_density(2)), HasSubstr("n2.nc: has 2 tubes per wavelength, as another one has"));
  EXPECT_THAT(says(at_density(8, "\"max_bounces\": 9")), HasSubstr("n8.nc: differs from n2.nc in its case"));
  ResultFile other = at_density(8);
  other.result.frequency_hz[1] = 9.5e9;
  EXPECT_THAT(says(other), HasSubstr("in its frequencies"));
  other = at_density(8);
  other.result.looks[0].phi_deg = 1;
  EXPECT_THAT(says(other), HasSubstr("in its looks"));
  other = at_density(8);
  other.result.attributes.back().second = "abd";
  EXPECT_THAT(says(other), HasSubstr("in its mesh"));
  other.result.attributes.clear();
  EXPECT_THAT(says(other), HasSubstr("holds no case"));
  EXPECT_THAT(refusal([] { density_results({at_density(2), at_density(4)}); }), HasSubstr("three densities or more"));
}

}  // namespace
}  // namespace raytube
