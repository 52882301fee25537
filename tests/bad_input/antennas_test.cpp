// Antennas at a finite distance through the real program: what is written, and what bad input is told.
#include "program.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

class AntennasProgram : public BadInput {};

constexpr const char* at_3_m = "case.toml --set radar.range_m=3 --set output.plots=false ";

TEST_F(AntennasProgram, ResultsTellTheirRangeAndWhatTheyAre) {
  EXPECT_EQ(raytube(std::string("run ") + at_3_m).code, 0);
  const std::string rcs = text_of(scratch / "out/rcs.csv");
  EXPECT_THAT(rcs, HasSubstr("err_hh_db,model_vv_db,model_vh_db,model_hv_db,model_hh_db,range_m,rx_range_m\n"));
  EXPECT_THAT(rcs, HasSubstr(",3,3\n"));
  EXPECT_THAT(rcs, HasSubstr("S is the apparent amplitude"));
  EXPECT_EQ(raytube(std::string("check ") + at_3_m).code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("antennas     3 m from the mesh's origin"));
}

TEST_F(AntennasProgram, ImagesSayThatTheyArePerspectives) {
  EXPECT_EQ(raytube(std::string("run ") + at_3_m + "--set output.image_look=0").code, 0);
  EXPECT_THAT(text_of(scratch / "out/image.csv"), HasSubstr("# Perspective from "));
  EXPECT_EQ(raytube("run case.toml --set output.plots=false --set output.image_look=0").code, 0);
  EXPECT_THAT(text_of(scratch / "out/image.csv"), ::testing::Not(HasSubstr("# Perspective from ")));
}

TEST_F(AntennasProgram, ReceivedPowerHasATableOfItsOwn) {
  const std::string radar = "--set radar.transmit_power_dbm=30 --set radar.gain_dbi=20 ";
  EXPECT_EQ(raytube(std::string("run ") + at_3_m + radar).code, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/power.csv"));
  EXPECT_EQ(raytube(std::string("run ") + at_3_m + radar + "--set output.power_dbm=true").code, 0);
  EXPECT_THAT(text_of(scratch / "out/power.csv"),
              HasSubstr("rx_phi_deg,range_m,rx_range_m,power_vv_dbm,power_vh_dbm,power_hv_dbm,power_hh_dbm\n"));
  EXPECT_EQ(raytube(std::string("run ") + at_3_m).code, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/power.csv"));
}

TEST_F(AntennasProgram, RefusesWhatItDoesNotKnow) {
  const std::string run = std::string("run ") + at_3_m;
  expect_refused(run + "--set output.image_look=0 --set output.image_per_wavelength=1e9", " would fit");
  expect_refused(run + "--set edges.method=utd --set edges.utd_range_m=3", "remove one of the two");
  expect_refused(run + "--set 'radar.aim_m=[0,0,9]' --set look.theta_deg=0", "radar.aim_m lies at an antenna, or behind one");
  expect_refused("run case.toml --set radar.range_m=1e300", "radar.range_m must be greater than 0 and at most 1e+12");
  for (const char* command : {"run ", "check ", "trace --look 0 --u 0 --v 0 "})
    expect_refused(std::string(command) + "case.toml --set radar.range_m=1e-6", "move it away (radar.range_m, radar.position_m)");
}

TEST_F(AntennasProgram, PatternsAreWholeAndAscendingAndReachAllOfTheTarget) {
  const auto refused = [&](const std::string& table, const std::string& says) {
    scratch.write("horn.csv", table);
    expect_refused(std::string("run ") + at_3_m + "--set radar.pattern_csv=horn.csv", says);
  };
  refused("", "the header must be \"angle_deg,azimuth_db,elevation_db\"");
  refused("angle,gain\n0,0\n", "the header must be \"angle_deg,azimuth_db,elevation_db\"");
  refused("angle_deg,azimuth_db,elevation_db\n0,0,0\n", "needs at least two rows");
  refused("angle_deg,azimuth_db,elevation_db\n0,0,0\n0,0,0\n", "angle_deg must ascend");
  refused("angle_deg,azimuth_db,elevation_db\n0,0,nan\n1,0,0\n", "write the level relative to the axis in dB");
  refused("angle_deg,azimuth_db,elevation_db\n-9,0,0\n0,30,0\n9,0,0\n", "levels are relative to the axis");
  refused("angle_deg,azimuth_db,elevation_db\n0,0,0\n90,1e308,0\n", "nowhere above 60 dB");
  refused("angle_deg,azimuth_db,elevation_db\n-1e-9,0,0\n1e-9,0,0\n", "beyond the pattern in radar.pattern_csv");
}

}  // namespace
}  // namespace raytube
