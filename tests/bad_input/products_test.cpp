// Range profiles and images through the real program: what it writes, and the sentences for sweeps that none can be made of.
#include "program.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Products : public BadInput {
 protected:
  void SetUp() override {
    BadInput::SetUp();
    ASSERT_EQ(raytube("run case.toml -o kept --quiet --set output.plots=false " + sweep).code, 0);
  }

  const std::string sweep =
      "--set edges.method=none --set 'frequency.ghz={start=9,stop=11,count=21}' --set look.theta_deg=60 --set target.unit=m "
      "--set 'look.phi_deg={start=-2.5,stop=2.5,count=11}'";
};

TEST_F(Products, OfAResultAndOfItsCaseAreTheSame) {
  const Outcome profile = raytube("profile kept/rcs.csv -o a");
  EXPECT_EQ(profile.code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), AllOf(HasSubstr("resolution"), HasSubstr("peak"), HasSubstr("profile.csv")));
  EXPECT_EQ(raytube("profile case.toml -o b --quiet " + sweep).code, 0);
  EXPECT_TRUE(text_of(scratch / "b/rcs.csv") == text_of(scratch / "kept/rcs.csv"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "b/waterfall.png"));
  EXPECT_TRUE(text_of(scratch / "a/profile.csv") == text_of(scratch / "b/profile.csv"));
  EXPECT_EQ(raytube("isar b -o b --quiet --size 0.3 0.3 --threads 1").code, 0);
  std::filesystem::copy_file(scratch / "kept/rcs.csv", scratch / "bare.csv");  // where nothing is known of the target, either
  EXPECT_EQ(raytube("isar bare.csv -o a --quiet --size 0.3 0.3").code, 0);
  EXPECT_EQ(raytube("isar kept/rcs.csv -o a --quiet --size 0.3 0.3 --threads 2").code, 0);
  EXPECT_TRUE(text_of(scratch / "a/isar.csv") == text_of(scratch / "b/isar.csv"));
  EXPECT_THAT(text_of(scratch / "a/isar.vti"), HasSubstr("<ImageData WholeExtent="));
}

// Rows of pulses with the columns of rcs.csv: two points would do, zeros are a result as well.
std::string rows_of_pulses(const std::vector<double>& times) {
  std::string text = "freq_hz,theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,re_vv,im_vv,re_vh,im_vh,re_hv,im_hv,re_hh,im_hh";
  for (const std::string column : {"sigma_{}_dbsm", "err_{}_db", "model_{}_db"})
    for (const char* channel : {"vv", "vh", "hv", "hh"}) text += ',' + std::string(column).replace(column.find("{}"), 2, channel);
  text += ",time_s\n";
  for (const double time : times)
    text += "1e9,90,0,90,0,1,0,0,0,0,0,1,0,11,-inf,-inf,11,0,0,0,0,0,0,0,0," + std::to_string(time) + '\n';
  return text;
}

TEST_F(Products, DopplerOfPulses) {
  scratch.write("pulses.csv", rows_of_pulses({0.0, 0.001, 0.002, 0.003}));
  scratch.write("uneven.csv", rows_of_pulses({0.0, 0.001, 0.002, 0.004}));
  EXPECT_EQ(raytube("doppler pulses.csv -o moving").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), AllOf(HasSubstr("unambiguous 149.9 m/s (1000 Hz)"),
                                                     HasSubstr("peak               10.99 dBsm"), HasSubstr("doppler.csv")));
  EXPECT_EQ(raytube("doppler pulses.csv -o moving --spectrogram --window-length 2 --overlap 0").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("2 of 2 pulses, every 0.002 s"));
  EXPECT_EQ(raytube("doppler pulses.csv -o moving --raw").code, 0);
  EXPECT_TRUE(std::filesystem::exists(scratch / "moving/raw.nc"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "moving/spectrogram.csv"));
  expect_refused("doppler kept/rcs.csv", "nothing moves, its looks have no times");
  expect_refused("doppler uneven.csv",
                 "times of pulses are not in even steps: from 0.002 to 0.004 s it is 0.002, elsewhere 0.001");
  expect_refused("doppler pulses.csv --look 1", "a pulse has no look 1");
  expect_refused("doppler pulses.csv --angle", "an angle takes antennas at places");
  expect_refused("doppler pulses.csv --mechanism bounce_1", "holds no mechanism bounce_1");
  expect_refused("doppler pulses.csv --spectrogram --window-length 5", "from 2 to 4");
}

TEST_F(Products, OneNetcdfFileStandsAlone) {
  EXPECT_EQ(raytube("profile case.toml -o one/p.nc " + sweep).code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("/one/p.nc\n"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "one/rcs.nc"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "one/profile.csv"));
  EXPECT_EQ(raytube("profile case.toml -o one/again.NC --quiet --threads 1 " + sweep).code, 0);
  EXPECT_TRUE(text_of(scratch / "one/p.nc") == text_of(scratch / "one/again.NC"));
  EXPECT_EQ(raytube("isar case.toml -o both --quiet --direct --set output.netcdf=true " + sweep).code, 0);
  EXPECT_EQ(raytube("isar case.toml -o one/i.nc --quiet --direct " + sweep).code, 0);
  EXPECT_TRUE(std::filesystem::exists(scratch / "both/isar.csv"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "both/isar.nc"));
  EXPECT_EQ(raytube("isar case.toml -o both --quiet --direct " + sweep).code, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch / "both/isar.nc")) << "of another image than isar.csv";
  expect_refused("profile kept/rcs.csv -o p.csv", "profile.csv among them, or one netCDF file; write -o DIR or -o p.nc");
  expect_refused("compare one/p.nc kept/rcs.csv", "give a netCDF file that raytube run or raytube convert has written");
  ASSERT_EQ(raytube("convert kept/rcs.csv rcs.nc").code, 0);
  expect_refused("profile rcs.nc -o rcs.nc", "rcs.nc");
}

// Looks ten degrees apart are too wide for the lobes of a metre at 10 GHz.
TEST_F(Products, TheyWarnAsARunDoes) {
  const std::string wide = sweep + " --quiet --set 'look.phi_deg={start=-20,stop=20,count=5}'";
  ASSERT_EQ(raytube("run case.toml -o run " + wide).code, 0);
  const std::string said = text_of(scratch / "stderr.txt");
  EXPECT_THAT(said, HasSubstr("sampling: steps of 10 deg in phi"));
  EXPECT_EQ(raytube("profile case.toml -o run.nc " + wide).complaint, said);
}

TEST_F(Products, SweepsThatNothingCanBeMadeOfAreRefused) {
  expect_refused("profile case.toml --set edges.method=none", "has one frequency; a range profile needs a band");
  expect_refused("isar case.toml --set edges.method=none", "has one frequency; an image needs several frequencies and several");
  expect_refused("profile case.toml " + sweep + " --set 'frequency.ghz=[9,10,12]'", "frequencies are not in even steps: from");
  expect_refused("isar case.toml " + sweep + " --set 'look.phi_deg=[0,1,3]'", "looks in phi are not in even steps: from 0 to 1");
  expect_refused("profile case.toml " + sweep + " --set 'frequency.ghz=[1,11]'", "compute frequencies in steps of");
  expect_refused("isar case.toml " + sweep + " --set 'look.phi_deg=[-60,0,60]'", "along cross_range, but steps of 60 degrees");
  expect_refused("isar case.toml " + sweep + " --set receive.theta_deg=80 --set receive.phi_deg=0", "its looks are bistatic");
}

// The plate is a metre wide and begins at its origin: its middle is in the middle.
TEST_F(Products, AnImageIsAboutTheTarget) {
  EXPECT_EQ(raytube("isar kept/rcs.csv -o a").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("isar_pauli.png"));
  EXPECT_EQ(raytube("profile kept/rcs.csv -o a --quiet").code, 0);
  // Of another run than the one whose run.json is beside it nothing is known.
  ASSERT_EQ(raytube("run case.toml -o other.nc --quiet " + sweep).code, 0);
  std::filesystem::copy_file(scratch / "other.nc", scratch / "kept/other.nc");
  EXPECT_EQ(raytube("isar kept/other.nc -o a --quiet --size 0.3 0.3").code, 0);
}

TEST_F(Products, WhatWouldTakeTooLongIsRefusedFirst) {
  expect_refused("isar case.toml " + sweep + " --set look.theta_deg=0", "at theta 0 degrees azimuth does not turn the target");
  expect_refused("isar case.toml --size 1x1x1 --pixels 32 " + sweep + " --set 'look.theta_deg={start=58,stop=62,count=9}'",
                 "an image of");
  expect_refused("isar --plan 1e6 0.1", "ask for a coarser resolution");
  expect_refused("isar --plan 5 0.1 --direct", "--direct: has no effect with --plan");
  expect_refused("isar case.toml --quiet --direct --mechanisms surface_waves " + sweep,
                 "--mechanisms surface_waves: add nothing in look 5");
  expect_refused("report case.toml", "case.toml: is a case, not a result");
}

TEST_F(Products, OptionsThatDoNotGoTogetherAreRefused) {
  expect_refused("profile kept/rcs.csv --window blackman", "needs rectangular, hann, hamming, taylor or kaiser (found blackman)");
  expect_refused("profile kept/rcs.csv --window hann --sidelobes 40", "--sidelobes: a hann window has side lobes of its own");
  expect_refused("profile kept/rcs.csv --set frequency.ghz=3", "has no effect on a finished result");
  expect_refused("profile kept/channels.csv", "its columns are not those of rcs.csv");
  expect_refused("isar", "input is required: a result or a case, or --plan SIZE RESOLUTION");
  expect_refused("isar kept/rcs.csv --plan 5 0.1", "--plan: computes nothing");
  expect_refused("isar kept/rcs.csv --ghz 10", "--ghz: has no effect without --plan");
  expect_refused("isar --plan 5 0.001", "takes a band of 149.9 GHz, which does not fit around 10 GHz");
  expect_refused("isar --plan 0.1 5 --ghz 1", "is below the resolution of 5 m");
  expect_refused("isar kept/rcs.csv --direct", "kept/rcs.csv is not a case (.toml); only a case says where its S comes from");
  expect_refused("isar case.toml --mechanisms edges", "--mechanisms requires --direct");
  expect_refused("isar case.toml --direct --mechanisms bounce_4",
                 "needs bounce_1, bounce_2, bounce_3_on, surface_waves, rounded_edges, "
                 "flat_tips, round_tips, edges, material_edges, plate_corners, thin_ends, solid_corners, interaction");
  expect_refused("isar kept/rcs.csv --size 20 1", "the image asked for is 20 m wide along range, but steps of 100 MHz show 1.");
  expect_refused("isar kept --size 8", "--size: needs two lengths in metres, or three for an image in space (found 8)");
  expect_refused("isar kept --size 8x", "or three for an image in space, such as 8x8 (found 8x)");
  expect_refused("isar kept --size 1 1 kept", "or three for an image in space, such as 8x8 (found kept)");
  expect_refused("isar kept --resume", "--resume: nothing is solved for kept/rcs.csv");
  expect_refused("isar .", "holds neither rcs.nc nor rcs.csv");
  expect_refused("isar kept/rcs.csv --size 0.3 0.3 0.3", "--size: an image over one angle is in a plane and has no height");
}

TEST_F(Products, SizesAreWrittenInSeveralWays) {
  ASSERT_EQ(raytube("isar kept -o a --quiet --size 0.3 0.4").code, 0);
  for (const char* words : {"--size 0.3x0.4 kept", "--size 0.3 0.4 kept", "--size 0.3,0.4 kept", "kept --size 0.3x0.4"}) {
    ASSERT_EQ(raytube(std::string("isar -o b --quiet ") + words).code, 0) << words;
    EXPECT_TRUE(text_of(scratch / "a/isar.csv") == text_of(scratch / "b/isar.csv")) << words;
  }
}

TEST_F(Products, AFolderOfARunIsAResult) {
  EXPECT_EQ(raytube("compare kept kept/rcs.csv --tolerance-relative 0").code, 0);
  EXPECT_EQ(raytube("convert kept there.nc").code, 0);
  EXPECT_EQ(raytube("profile kept --quiet").code, 0);
  EXPECT_TRUE(std::filesystem::exists(scratch / "kept/profile.csv"));
}

TEST_F(Products, ALookThatIsThereTwiceIsTold) {
  const Outcome twice = raytube("profile case.toml -o twice.nc --quiet " + sweep + " --set 'look.phi_deg=[0,1,0]'");
  EXPECT_EQ(twice.code, 0);
  EXPECT_THAT(twice.complaint, HasSubstr("look 2 (theta 60, phi 0) has the directions of look 0; both are shown\n"));
}

TEST_F(Products, OneLookMakesAnImageByItself) {
  const std::string options = " --direct --quiet --size 1.4x1.4 ";
  EXPECT_EQ(raytube("isar case.toml -o a" + options + sweep + " --threads 1").code, 0);
  EXPECT_EQ(raytube("isar case.toml -o b" + options + sweep + " --threads 2").code, 0);
  EXPECT_TRUE(text_of(scratch / "a/isar.csv") == text_of(scratch / "b/isar.csv"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "a/rcs.nc"));
  expect_refused("isar case.toml --direct " + sweep + " --set radar.range_m=100", "the pieces seen from a finite distance");
  const Outcome profile = raytube("profile case.toml -o c --direct " + sweep);
  EXPECT_THAT(profile.complaint, HasSubstr("look 5 at 10 GHz"));
  const std::string table = text_of(scratch / "c/profile.csv");
  EXPECT_THAT(table, HasSubstr("\n60,0,60,0,"));
  EXPECT_THAT(table, Not(HasSubstr("\n60,0.5,")));
}

TEST_F(Products, CentresAreThoseOfOneLook) {
  EXPECT_EQ(raytube("centres case.toml -o a --quiet --set target.unit=m").code, 0);
  EXPECT_THAT(text_of(scratch / "a/centres.csv"), AllOf(HasSubstr("\n1,"), HasSubstr("\nrest,,,,,"), HasSubstr("bounce_1")));
  EXPECT_THAT(text_of(scratch / "a/centres.ply"), HasSubstr("element vertex "));
  EXPECT_TRUE(std::filesystem::exists(scratch / "a/centres.png"));
  EXPECT_THAT(text_of(scratch / "a/centres.svg"), AllOf(HasSubstr("bounce 1"), HasSubstr("cross-range (m)"), HasSubstr(">1")));
  scratch.write("named.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng near\nf 1 2 3\ng far, side\nf 1 3 4\n");
  EXPECT_EQ(raytube("centres case.toml -o b --quiet --set target.unit=m --set target.mesh=named.obj").code, 0);
  EXPECT_THAT(text_of(scratch / "b/by_part.csv"),
              AllOf(HasSubstr("\nnear,tubes,"), HasSubstr("\n\"far,, side\""), HasSubstr("\n,all,")));
  expect_refused("centres kept/rcs.csv", "kept/rcs.csv is not a case (.toml)");
  expect_refused("centres case.toml --look 1", "look 1: there are 1 direction pair(s), counted from 0");
  expect_refused("centres case.toml --set target.unit=m --resolution 1e-4", "has too many pieces of 2.5e-05 m");
  expect_refused("centres case.toml --set radar.range_m=100", "the pieces seen from a finite distance have no one place");
}

TEST_F(Products, APlanIsACase) {
  const Outcome plan = raytube("isar --plan 0.2 0.05");
  EXPECT_EQ(plan.code, 0);
  scratch.write("planned.toml", target + text_of(scratch / "stdout.txt") + "[edges]\nmethod = \"none\"\n");
  EXPECT_EQ(raytube("isar planned.toml -o planned --quiet").code, 0);
}

}  // namespace
}  // namespace raytube
