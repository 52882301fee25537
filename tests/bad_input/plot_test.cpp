// raytube plot and raytube statistics through the real program: what they write, and what bad input is told.
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class PlotProgram : public BadInput {
 protected:
  void SetUp() override {
    BadInput::SetUp();
    fs::create_directory(scratch / "in");
    std::string cut = "freq_hz,theta_deg,phi_deg,sigma_vv_dbsm,sigma_hh_dbsm\n", band = cut;
    for (int i = 0; i < 40; ++i) {
      cut += "1e10,90," + std::to_string(i) + ',' + std::to_string(-0.3 * i) + ",-3\n";
      band += std::to_string(1 + i) + "e9,90,0,1,2\n";
    }
    scratch.write("in/cut.csv", cut);
    scratch.write("in/band.csv", band);
  }

  std::string printed() const { return text_of(scratch / "stdout.txt"); }
};

TEST_F(PlotProgram, WritesTheKindsOfPictures) {
  EXPECT_EQ(raytube("plot in/cut.csv").code, 0);
  EXPECT_THAT(printed(), AllOf(StartsWith("picture in "), HasSubstr("in: plot.png, plot.svg\n")));
  EXPECT_TRUE(fs::exists(scratch / "in/plot.png") && fs::exists(scratch / "in/plot.svg"));
  EXPECT_EQ(raytube("plot in/cut.csv -o out/a.png --size 400x300 --quiet").code, 0);
  EXPECT_EQ(printed(), "");
  const std::string png = text_of(scratch / "out/a.png");
  EXPECT_EQ(png.substr(16, 8), std::string("\0\0\1\x90\0\0\1\x2c", 8));  // its width and height (ISO/IEC 15948, 11.2.2)
  EXPECT_EQ(raytube("plot in/cut.csv in/cut.csv -o out/a.pdf --style print --channels vv").code, 0);
  EXPECT_THAT(text_of(scratch / "out/a.pdf"), StartsWith("%PDF-"));
  EXPECT_EQ(raytube("plot in/cut.csv -o out/a.svg --kind polar --unit db-peak --range 20").code, 0);
  EXPECT_EQ(raytube("plot in/cut.csv -o pictures --unit m2").code, 0);
  EXPECT_TRUE(fs::exists(scratch / "pictures/plot.png"));
}

TEST_F(PlotProgram, ASingleLookIsATable) {
  ASSERT_EQ(raytube("run case.toml --set output.netcdf=true --set output.plots=false").code, 0);
  for (const char* file : {"out/rcs.csv", "out/rcs.nc"}) {
    EXPECT_EQ(raytube(std::string("plot ") + file).code, 0);
    EXPECT_THAT(printed(), AllOf(HasSubstr(": a single look, as a table in place of a picture\n10 GHz, θ = 10°, φ = 0°\n"),
                                 HasSubstr("model uncertainty, dB"), HasSubstr("\n  HH ")));
  }
  EXPECT_FALSE(fs::exists(scratch / "out/plot.png"));
}

TEST_F(PlotProgram, ReplacesItsOwnPicturesOnly) {
  EXPECT_EQ(raytube("plot in/cut.csv -o in/a.png").code, 0);
  EXPECT_EQ(raytube("plot in/band.csv -o in/a.png").code, 0);
  scratch.write("in/mine.png", "mine");
  expect_refused("plot in/cut.csv -o in/mine.png", "mine.png");
  EXPECT_EQ(text_of(scratch / "in/mine.png"), "mine");
  fs::permissions(scratch.write("gnuplot", "#!/bin/sh\nexit 1\n"), fs::perms::owner_all);
  const std::string before = text_of(scratch / "in/a.png");
  const Outcome outcome = raytube("plot in/cut.csv -o in/a.png", "PATH=.:$PATH ");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.complaint, "raytube: no picture a.png: gnuplot failed with status 1\n");
  EXPECT_EQ(text_of(scratch / "in/a.png"), before);
}

TEST_F(PlotProgram, BadInput) {
  expect_refused("plot", "see raytube --help");
  expect_refused("plot in/none.csv -o out", "none.csv: cannot be read");
  expect_refused("plot in/cut.csv -o out --kind pie", "--kind pie: is none; choose among auto, curves, map, polar");
  expect_refused("plot in/cut.csv -o out --unit db", "--unit db: is none; choose among dbsm, m2, db-peak");
  expect_refused("plot in/cut.csv -o out --style dark", "--style dark: is none; choose among screen, print");
  expect_refused("plot in/cut.csv -o out --kind map", "--kind map: in/cut.csv holds no grid over two quantities");
  expect_refused("plot in/band.csv -o out --kind polar", "not over an angle");
  expect_refused("plot in/cut.csv in/band.csv -o out", "plot them one by one");
  expect_refused("plot in/cut.csv -o out --channels vv,xx", "--channels vv,xx: write some of vv,vh,hv,hh");
  expect_refused("plot in/cut.csv -o out --channels vh", "--channels vh: in/cut.csv has no such channel");
  for (const char* size : {"0x0", "800", "99x500", "800x-600", "1e3x600", "800x600x2", "20000x20000", "200x801"})
    expect_refused(std::string("plot in/cut.csv -o out --size ") + size, std::string("--size ") + size + ": write WIDTHxHEIGHT");
  for (const char* range : {"0", "-3", "nan", "400", "wide"})
    expect_refused(std::string("plot in/cut.csv -o out --range ") + range, "--range: needs a number of decibels above 0");
  expect_refused("plot in/cut.csv -o out --range 20 --unit m2", "--range: square metres have no range in dB");
  expect_refused("plot in/cut.csv -o out.jpg", "-o out.jpg: no such picture is drawn; name a .png, .svg or .pdf");
  scratch.write("in/one.csv", "phi_deg,sigma_vv_dbsm\n1,2\n");
  expect_refused("plot in/cut.csv in/one.csv -o out", "in/one.csv: a single look makes no curve beside others");
}

TEST_F(PlotProgram, Statistics) {
  EXPECT_EQ(raytube("statistics in/cut.csv").code, 0);
  EXPECT_THAT(printed(), AllOf(HasSubstr("rows                                          40"), HasSubstr("10 % lie below, dBsm"),
                               HasSubstr("Swerling III")));
  EXPECT_EQ(raytube("statistics in/cut.csv --only phi_deg=0:19 --window 5 --percentiles 5,95 -o out").code, 0);
  for (const char* name : {"statistics.csv", "fits.csv", "histogram.csv", "statistics.png", "statistics.svg"})
    EXPECT_TRUE(fs::exists(scratch / "out" / name)) << name;
  EXPECT_THAT(text_of(scratch / "out/statistics.csv"), HasSubstr(",p5_dbsm,p95_dbsm,std_db\n,,,,,,,vv,20,"));
  EXPECT_THAT(text_of(scratch / "out/fits.csv"), HasSubstr("\nvv,swerling_1,"));
}

TEST_F(PlotProgram, StatisticsOfBadInput) {
  expect_refused("statistics in/cut.csv --only phi_deg=90 -o out", "no row has phi_deg from 90 to 90; widen --only");
  expect_refused("statistics in/cut.csv --only phi=90 -o out", "--only phi=90: write COLUMN=VALUE");
  scratch.write("in/phi.csv", "phi_deg,sigma_vv_dbsm\n1,2\n2,2\n");
  expect_refused("statistics in/phi.csv --only theta_deg=90 -o out", "--only theta_deg=90: in/phi.csv has no such column");
  expect_refused("statistics in/band.csv --window 5 -o out",
                 "--window: in/band.csv is a sweep over frequency (GHz), not over an angle");
  expect_refused("statistics in/cut.csv --window 50 -o out", "--window 50: in/cut.csv sweeps over 39 degrees only");
  expect_refused("statistics in/cut.csv --window 5", "--window: what the windows hold is written, not printed; name a folder");
  for (const char* window : {"0", "-1", "361", "nan"})
    expect_refused(std::string("statistics in/cut.csv -o out --window ") + window, "--window: needs a width in degrees above 0");
  for (const char* percentiles : {"50,10", "101", "-1", "ten", "10,,50", "nan"})
    expect_refused(std::string("statistics in/cut.csv -o out --percentiles=") + percentiles,
                   "write ascending numbers from 0 to 100");
}

}  // namespace
}  // namespace raytube
