// netCDF files through the real program: run -o FILE.nc, output.netcdf, convert, compare, converge.
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

class NetcdfProgram : public BadInput {
 protected:
  /// Files in the scratch folder but those of the harness.
  std::vector<std::string> names(const std::string& folder) const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(scratch / folder)) found.push_back(entry.path().filename().string());
    std::ranges::sort(found);
    return found;
  }

  void expect_same(const std::string& a, const std::string& b) const {
    EXPECT_FALSE(text_of(scratch / a).empty());
    EXPECT_TRUE(text_of(scratch / a) == text_of(scratch / b)) << a << " and " << b;
  }
};

const std::string quick = " --quiet --set output.plots=false ";

TEST_F(NetcdfProgram, OneFileAloneHoldsTheResult) {
  ASSERT_EQ(raytube("run case.toml -o one/rcs.nc --quiet").code, 0);
  EXPECT_EQ(names("one"), (std::vector<std::string>{".raytube.results", "rcs.nc"}));
  ASSERT_EQ(raytube("run case.toml -o out" + quick).code, 0);
  ASSERT_EQ(raytube("convert one/rcs.nc one/rcs.csv").code, 0);
  expect_same("one/rcs.csv", "out/rcs.csv");
}

TEST_F(NetcdfProgram, TheKeyAddsItToTheOthersAndItGoesWithThem) {
  ASSERT_EQ(raytube("run case.toml --set output.netcdf=true" + quick).code, 0);
  EXPECT_EQ(names("out"), (std::vector<std::string>{".raytube.results", "channels.csv", "rcs.csv", "rcs.nc", "run.json"}));
  EXPECT_THAT(text_of(scratch / "out/run.json"), HasSubstr("\"netcdf\": true"));
  ASSERT_EQ(raytube("run case.toml" + quick).code, 0);
  EXPECT_EQ(names("out"), (std::vector<std::string>{".raytube.results", "channels.csv", "rcs.csv", "run.json"}));
}

TEST_F(NetcdfProgram, TheBytesAreTheSameForAnyNumberOfThreadsAndInAnyFolder) {
  const std::string sweep = " --parts --set 'look.phi_deg={start=0,stop=20,step=1}'" + quick;
  ASSERT_EQ(raytube("run case.toml -o a.nc --threads 1" + sweep).code, 0);
  ASSERT_EQ(raytube("run case.toml -o elsewhere/b.nc --threads 2" + sweep).code, 0);
  expect_same("a.nc", "elsewhere/b.nc");
}

TEST_F(NetcdfProgram, ConvertsThereAndBack) {
  const std::string bistatic = " --set 'receive.theta_deg=[10,20]' --set receive.phi_deg=5 --set radar.range_m=3";
  ASSERT_EQ(raytube("run case.toml -o kept --set radar.receive_range_m=4 --set edges.method=none" + bistatic + quick).code, 0);
  ASSERT_EQ(raytube("convert kept/rcs.csv a.nc").code, 0);
  ASSERT_EQ(raytube("convert a.nc b.csv").code, 0);
  expect_same("b.csv", "kept/rcs.csv");
  ASSERT_EQ(raytube("convert b.csv a.nc").code, 0) << "over its own";
  EXPECT_EQ(raytube("compare a.nc kept/rcs.csv --tolerance-relative 0").code, 0);
}

TEST_F(NetcdfProgram, ConvertRefusesWithASentence) {
  ASSERT_EQ(raytube("run case.toml -o kept" + quick).code, 0);
  expect_refused("convert kept/rcs.csv", "to is required");
  expect_refused("convert kept/rcs.csv a.csv", "are of the same kind; convert a .csv to a .nc");
  expect_refused("convert kept/rcs.csv a.json", "a.json: its name ends neither in .csv nor in .nc");
  expect_refused("convert missing.csv a.nc", "missing.csv: cannot be read; give the path of a readable table");
  expect_refused("convert missing.nc a.csv", "missing.nc: cannot be read; give the path of a netCDF file");
  expect_refused("convert kept/channels.csv a.nc", "its columns are not those of rcs.csv");
  expect_refused("convert kept/rcs.csv missing/a.nc", "its folder does not exist");
  scratch.write("mine.nc", "mine");
  expect_refused("convert kept/rcs.csv mine.nc", "mine.nc: exists, and is not a file that raytube has written");
  EXPECT_EQ(text_of(scratch / "mine.nc"), "mine");
  EXPECT_FALSE(fs::exists(scratch / "a.nc"));
}

// HDF5 by itself crashes at its end where a disk did not take all of a file. The limit is in blocks of
// 512 bytes or 1 kB; a file has more than 20 kB either way.
TEST_F(NetcdfProgram, AFullDiskIsSaidAndLeavesNothing) {
  ASSERT_EQ(raytube("run case.toml -o kept" + quick).code, 0);
  const Outcome full = raytube("convert kept/rcs.csv a.nc", "ulimit -f 16 && ");
  EXPECT_EQ(full.code, 3);
  EXPECT_THAT(full.complaint, HasSubstr("a.nc: cannot be written completely; is the disk full?"));
  EXPECT_FALSE(fs::exists(scratch / "a.nc"));
}

TEST_F(NetcdfProgram, WhatOneFileCannotHoldIsSaid) {
  scratch.write("mine.nc", "mine");
  expect_refused("run case.toml -o mine.nc", "is not as raytube wrote it");
  expect_refused("run case.toml --set output.netcdf=1", "output.netcdf must be true or false");
  const Outcome image = raytube("run case.toml -o a.nc --quiet --set output.image_look=0");
  EXPECT_EQ(image.code, 0);
  EXPECT_THAT(image.complaint, HasSubstr("output.image_look has no effect with -o a.nc"));
}

TEST_F(NetcdfProgram, ConvergeOfResultsIsThatOfTheCase) {
  const std::string setting = " --quiet --set target.unit=m --set frequency.ghz=1 --set tubes.mode=uniform";
  for (const std::string n : {"2", "4", "8"})
    ASSERT_EQ(raytube("run case.toml -o n" + n + ".nc --set tubes.per_wavelength=" + n + setting).code, 0);
  ASSERT_EQ(raytube("converge n4.nc n2.nc n8.nc -o study").code, 0);
  ASSERT_EQ(raytube("converge case.toml -o whole --densities 2,4,8" + setting).code, 0);
  const auto conclusions = [&](const std::string& file) {
    const std::string text = text_of(scratch / file);
    return text.substr(0, text.find("\nper_wavelength"));
  };
  EXPECT_THAT(conclusions("study/converge.csv"), HasSubstr("# order "));
  EXPECT_EQ(conclusions("study/converge.csv"), conclusions("whole/converge.csv"));
  EXPECT_TRUE(fs::exists(scratch / "study/converge.png"));
  expect_refused("converge n2.nc n4.nc", "an order needs results at three densities or more");
  expect_refused("converge n2.nc case.toml", "case.toml: is not a netCDF file");
  expect_refused("converge n2.nc n4.nc n8.nc --densities 2,4,8", "--densities: has no effect on finished results");
  ASSERT_EQ(raytube("run case.toml -o adaptive.nc --quiet").code, 0);
  expect_refused("converge n2.nc n4.nc adaptive.nc", "adaptive.nc: its tubes are adaptive, without a density to study");
}

TEST_F(NetcdfProgram, CompareTakesNoColumnsForIt) {
  ASSERT_EQ(raytube("run case.toml -o a.nc --quiet").code, 0);
  expect_refused("compare a.nc a.nc --result-columns re_vv=x", "a.nc has variables, no columns");
}

}  // namespace
}  // namespace raytube
