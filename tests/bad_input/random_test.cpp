// raytube run --launch random through the real program: what is written, and what bad input is told.
#include <map>
#include <nlohmann/json.hpp>

#include "core/csv_reader.h"
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

class RandomProgram : public BadInput {};

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const fs::path& file) {
  std::vector<Row> rows;
  for (CsvReader reader(file, ""); reader.next();) {
    Row& row = rows.emplace_back();
    for (std::size_t i = 0; i < reader.columns().size(); ++i) row[reader.columns()[i]] = reader.cell(i);
  }
  return rows;
}

double number(const Row& row, const char* column) { return parsed_number(row.at(column)).value(); }

TEST_F(RandomProgram, WritesMeanSpreadAndBias) {
  EXPECT_EQ(raytube("run case.toml --launch random --samples 200 --seed 3 --repeat 4 --set output.plots=false").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("launch      random: 4 runs of 200 tubes a look, seed 3\n"));
  EXPECT_THAT(text_of(scratch / "out/rcs.csv"), HasSubstr("# launch = random: S is the mean of 4 runs of 200 random tubes"));
  const std::vector<Row> rcs = rows_of(scratch / "out/rcs.csv"), random = rows_of(scratch / "out/random.csv");
  ASSERT_EQ(rcs.size(), 1u);
  ASSERT_EQ(random.size(), 4u);
  EXPECT_EQ(random[3].at("channel"), "hh");
  EXPECT_EQ(random[0].at("re_mean"), rcs[0].at("re_vv"));
  EXPECT_EQ(number(random[0], "im_mean") - number(random[0], "im_det"), number(random[0], "im_bias"));
  EXPECT_DOUBLE_EQ(number(random[0], "spread_m") / 2.0, number(random[0], "error_m"));  // root of 4 runs
  const auto launch = nlohmann::json::parse(text_of(scratch / "out/run.json"))["launch"];
  EXPECT_EQ(launch["kind"], "random");
  EXPECT_EQ(launch["samples"], 200);
  EXPECT_EQ(launch["seed"], 3);
  EXPECT_EQ(launch["repeat"], 4);
}

TEST_F(RandomProgram, AnOrdinaryRunLeavesNoTableOfAnEarlierRandomOne) {
  EXPECT_EQ(raytube("run case.toml --launch random --samples 20 --repeat 2 --set output.plots=false").code, 0);
  EXPECT_TRUE(fs::exists(scratch / "out/random.csv"));
  EXPECT_EQ(raytube("run case.toml --set output.plots=false").code, 0);
  EXPECT_FALSE(fs::exists(scratch / "out/random.csv"));
  EXPECT_FALSE(nlohmann::json::parse(text_of(scratch / "out/run.json")).contains("launch"));
}

TEST_F(RandomProgram, BadOptions) {
  expect_refused("run case.toml --launch random --set output.image_look=0", "an image adds up to the deterministic S");
  expect_refused("run case.toml --samples 10", "--samples requires --launch");
  expect_refused("run case.toml --seed 1", "--seed requires --launch");
  expect_refused("run case.toml --repeat 2", "--repeat requires --launch");
  expect_refused("run case.toml --launch grid", "--launch: write random, or leave it out (found grid)");
  expect_refused("run case.toml --launch random --samples 0", "--samples: needs a whole number from 1 to 1000000000 (found 0)");
  expect_refused("run case.toml --launch random --samples 1e5", "--samples: needs a whole number");
  expect_refused("run case.toml --launch random --repeat 1", "--repeat: needs a whole number from 2 to 1000000 (found 1)");
  expect_refused("run case.toml --launch random --seed -1", "--seed: needs a whole number from 0");
  expect_refused("run case.toml --launch random --parts", "--parts: the mean of random tubes is not split by mechanism");
  expect_refused("run case.toml --launch random --set edges.method=utd", "edges.method \"utd\" has no tubes to place at random");
}

}  // namespace
}  // namespace raytube
