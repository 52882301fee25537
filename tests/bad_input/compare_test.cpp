// raytube compare through the real program: exit codes, what is written, what bad input is told.
#include <fmt/format.h>

#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

class CompareProgram : public BadInput {
 protected:
  void SetUp() override {
    BadInput::SetUp();
    scratch.write("a.csv", "freq_hz,theta_deg,phi_deg,sigma_vv_dbsm,sigma_hh_dbsm\n1e9,90,0,10.5,-3\n1e9,90,1,8,-4\n");
    scratch.write("b.csv", "freq_hz,theta_deg,phi_deg,sigma_vv_dbsm,sigma_hh_dbsm\n1e9,90,0,10,-3\n1e9,90,1,8,-4\n");
  }
};

TEST_F(CompareProgram, SaysHowFarApartTheyAre) {
  EXPECT_EQ(raytube("compare a.csv b.csv").code, 0);
  const std::string text = text_of(scratch / "stdout.txt");
  for (const char* part : {"compared    2 rows", "rms                                                   0.3536           0",
                           "largest in vv: 1 GHz, θ = 90°, φ = 0°, 10.5 against 10 dBsm"})
    EXPECT_THAT(text, HasSubstr(part));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder()), {}),
            6);  // two tables, mesh, case, stdout, stderr: no new ones
}

TEST_F(CompareProgram, ExitCodeTellsTheTolerance) {
  EXPECT_EQ(raytube("compare a.csv b.csv --tolerance-db 0.4").code, 0);
  const Outcome above = raytube("compare a.csv b.csv --tolerance-db 0.3 -o out");
  EXPECT_EQ(above.code, 1);
  EXPECT_EQ(above.complaint, "raytube: rms error above the tolerance of 0.3 dB: vv 0.3536 dB\n");
  EXPECT_TRUE(fs::exists(scratch / "out/compare.csv"));  // that it fell short is a result, too
  EXPECT_EQ(raytube("compare b.csv b.csv --tolerance-db 0").code, 0);
  EXPECT_EQ(raytube("compare a.csv b.csv --tolerance-db 0.3 --only phi_deg=1").code, 0);
}

TEST_F(CompareProgram, ImagesLeaveATableAndAPicture) {
  std::string image = "line,col,mag\n", brighter = image;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 5; ++column) {
      const double size = 1.0 / (1.0 + (row - 3) * (row - 3) + (column - 2) * (column - 2));
      image += fmt::format("{},{},{}\n", row, column, size), brighter += fmt::format("{},{},{}\n", row, column, 2.0 * size);
    }
  scratch.write("image.csv", image), scratch.write("brighter.csv", brighter);
  const std::string names =
      " --result-columns row=line,magnitude_vv=mag --reference-columns row=line,magnitude_vv=mag --tolerance-db 0.01";
  const Outcome above = raytube("compare brighter.csv image.csv -o out" + names);
  EXPECT_EQ(above.code, 1);
  EXPECT_EQ(above.complaint, "raytube: rms error above the tolerance of 0.01 dB: vv 6.021 dB\n");
  EXPECT_THAT(text_of(scratch / "out/compare.csv"), HasSubstr("\nvv,6.020"));
  EXPECT_TRUE(fs::exists(scratch / "out/compare.png"));
  EXPECT_EQ(raytube("compare brighter.csv image.csv -o out --free-scale" + names).code, 0);  // what it left is replaced
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("scaled      the result by -6.021 dB, fitted (--free-scale)"));
}

TEST_F(CompareProgram, ExitCodeTellsTheRelativeTolerance) {
  scratch.write("s.csv", "freq_hz,theta_deg,phi_deg,re_vv,im_vv\n1e9,90,0,3,4\n1e9,90,1,0,0\n");
  scratch.write("t.csv", "freq_hz,theta_deg,phi_deg,re_vv,im_vv\n1e9,90,0,3,4\n1e9,90,1,0,0.005\n");
  EXPECT_EQ(raytube("compare t.csv s.csv --tolerance-relative 0.0011").code, 0);
  const Outcome above = raytube("compare t.csv s.csv --tolerance-relative 0.0009");
  EXPECT_EQ(above.code, 1);
  EXPECT_EQ(above.complaint, "raytube: relative error 0.001 of complex S above the tolerance of 0.0009\n");
  scratch.write("longer.csv", text_of(scratch / "s.csv") + "1e9,90,2,0,0\n");
  const std::string none = "raytube: no relative error: one of the tables has rows or channels of its own, or no phase\n";
  EXPECT_EQ(raytube("compare longer.csv s.csv --tolerance-relative 1").complaint, none);
  EXPECT_EQ(raytube("compare a.csv b.csv --tolerance-relative 1").complaint, none);
  EXPECT_EQ(raytube("compare t.csv s.csv --tolerance-relative -1").code, 2);
}

TEST_F(CompareProgram, ReplacesWhatAnEarlierOneLeft) {
  ASSERT_EQ(raytube("compare a.csv a.csv -o out").code, 0);
  ASSERT_TRUE(fs::exists(scratch / "out/compare.png"));
  scratch.write("out/rcs.csv", "earlier");
  fs::permissions(scratch.write("python", "#!/bin/sh\nexit 1\n"), fs::perms::owner_all);
  const Outcome outcome = raytube("compare a.csv b.csv -o out", "RAYTUBE_PYTHON=./python ");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint, HasSubstr("no pictures"));
  EXPECT_THAT(text_of(scratch / "out/compare.csv"), HasSubstr("vv,10.5,10,2,2,"));
  EXPECT_FALSE(fs::exists(scratch / "out/compare.png"));
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), "earlier");
}

TEST_F(CompareProgram, InterruptWhilePlottingLeavesNothing) {
  fs::permissions(scratch.write("python", "#!/bin/sh\nexec sleep 100\n"), fs::perms::owner_all);
  const Outcome outcome =
      raytube("compare a.csv b.csv -o out", "RAYTUBE_PYTHON=./python timeout --preserve-status -s INT -k 5 1 ");
  EXPECT_EQ(outcome.code, 130);
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

// channels.csv of a run holds what its rcs.csv holds; under other names and in other units, too. What is left is rounding.
TEST_F(CompareProgram, FourChannelTablesOfAnySource) {
  ASSERT_EQ(raytube("run case.toml --set look.theta_deg='[10,20,30]' --set look.phi_deg=20 --set output.plots=false").code, 0);
  EXPECT_EQ(raytube("compare out/channels.csv out/rcs.csv --tolerance-db 1e-10").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("compared    3 rows"));
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("relative error of complex S"));
  const std::string rename =
      "sed '1s/.*/ghz,el,az,pol,a,b,c,d/; 2,$s/^\\([^,]*\\)000000000,\\([^,]*\\)/\\1,-\\2/' out/channels.csv >renderer.csv && ";
  EXPECT_EQ(raytube("compare out/rcs.csv renderer.csv --tolerance-db 1e-10 --reference-columns "
                    "'freq_hz=ghz*1e9,theta_deg=el*-1,phi_deg=az,tx_pol=pol,v_magnitude=a,v_phase_rad=b,h_magnitude=c,"
                    "h_phase_rad=d'",
                    rename)
                .code,
            0);
  fs::remove_all(scratch / "out");
  expect_refused("compare a.csv b.csv -o out --result-columns freq_hz=f", "a.csv, line 1: no column is named f; choose among");
  expect_refused("compare a.csv b.csv -o out --reference-columns f=freq_hz", "--reference-columns f=freq_hz: f is no column");
}

TEST_F(CompareProgram, BadTables) {
  expect_refused("compare none.csv b.csv -o out", "none.csv: cannot be read; give the path of a readable table");
  expect_refused("compare a.csv . -o out", "neither rcs.nc nor rcs.csv");
  scratch.write("c.csv", "0,1,2,3,4\n");
  expect_refused("compare a.csv c.csv -o out", "c.csv, line 1: no header");
  scratch.write("c.csv", "phi,sigma\n0,1\n");
  expect_refused("compare a.csv c.csv -o out", "c.csv, line 1: no column to match rows by");
  scratch.write("c.csv", "# c\nphi_deg,sigma_vv_dbsm\n0,1\n1,x1\n");
  expect_refused("compare a.csv c.csv -o out", "c.csv, line 4, column sigma_vv_dbsm: \"x1\" is not a finite number");
  scratch.write("c.csv", "phi_deg,sigma_vv_dbsm\n50,1\n");
  expect_refused("compare a.csv c.csv -o out", "have no row in common");
}

TEST_F(CompareProgram, BadOptions) {
  expect_refused("compare a.csv", "reference is required");
  expect_refused("compare a.csv b.csv a.csv", "a.csv");
  expect_refused("compare a.csv b.csv --tolerance-db -1", "--tolerance-db");
  expect_refused("compare a.csv b.csv --tolerance-db nan", "--tolerance-db");
  expect_refused("compare a.csv b.csv --within-db much", "--within-db");
  expect_refused("compare a.csv b.csv --only phi_deg", "--only phi_deg: write COLUMN=VALUE or COLUMN=LOW:HIGH");
  expect_refused("compare a.csv b.csv --only phi_deg=2:1", "--only phi_deg=2:1: write");
  expect_refused("compare a.csv b.csv --only phi=1", "--only phi=1: write");
  expect_refused("compare a.csv b.csv --only phi_deg=7", "a.csv: no row has phi_deg from 7 to 7; widen --only");
  scratch.write("c.csv", "phi_deg,sigma_vv_dbsm\n0,1\n");
  expect_refused("compare c.csv c.csv --only freq_hz=7", "neither c.csv nor c.csv has that column");
  scratch.write("file", "");
  EXPECT_EQ(raytube("compare a.csv b.csv -o file").code, 2);
}

}  // namespace
}  // namespace raytube
