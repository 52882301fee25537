// Reports through the real program: what is written, and the sentences for folders that none can be made of. What a page shows is
// tried in a browser (tests/report).
#include "program.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Report : public BadInput {
 protected:
  void SetUp() override {
    BadInput::SetUp();
    ASSERT_EQ(raytube("run case.toml -o kept --parts --quiet " + settings).code, 0);
  }

  std::string page(const std::string& name = "kept/report.html") const { return text_of(scratch / name); }

  const std::string settings =
      "--set output.plots=false --set edges.method=none --set target.unit=m --set 'title=\"</script><b> & \"' --set "
      "'look.phi_deg={start=0,stop=4,count=5}'";
};

TEST_F(Report, HasAllOfTheFolderOnOnePage) {
  EXPECT_EQ(raytube("report kept").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("report.html"));
  EXPECT_THAT(page(),
              AllOf(StartsWith("<!DOCTYPE html><!-- report of raytube -->\n"), HasSubstr("\"bounce 1\""),
                    HasSubstr("The strongest return is"), HasSubstr("\"triangles_traced\":2"), HasSubstr("\"vertices\"")));
  EXPECT_THAT(page(), Not(HasSubstr("</script><b>")));
  EXPECT_EQ(raytube("report kept/rcs.csv -o other.html --looks 0,4 --quiet").code, 0);
  EXPECT_EQ(text_of(scratch / "stdout.txt"), "");
  EXPECT_THAT(page("other.html"), AllOf(HasSubstr("\"look\":0"), HasSubstr("\"look\":4")));
}

// Settings of the command line are those of the target in space, too: it is a metre wide, not a millimetre.
TEST_F(Report, IsTheSameTwiceAndOfANetcdfFile) {
  ASSERT_EQ(raytube("report kept --quiet").code, 0);
  const std::string first = page();
  ASSERT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_TRUE(first == page());
  ASSERT_EQ(raytube("run case.toml -o one.nc --parts --quiet " + settings).code, 0);
  EXPECT_EQ(raytube("report one.nc --quiet").code, 0);
  EXPECT_THAT(page("report.html"), AllOf(HasSubstr("\"bounce 1\""), HasSubstr("The target in space: its case or mesh")));
}

TEST_F(Report, UsesTheImagesOfARun) {
  ASSERT_EQ(raytube("run case.toml -o images --quiet --set output.image_look=[1,2] " + settings).code, 0);
  EXPECT_EQ(raytube("report images --quiet").code, 0);
  EXPECT_THAT(page("images/report.html"), AllOf(HasSubstr("\"look\":1"), HasSubstr("\"look\":2"), Not(HasSubstr("\"look\":0"))));
  scratch.write("images/image_1_mesh.vtu", "nothing");
  expect_refused("report images", "image_1_mesh.vtu: is no image of a look");
}

// Of a target of several files, named on the command line alone.
TEST_F(Report, SaysWhatItLacks) {
  scratch.write("other.off", "OFF\n3 1 0\n0 0 2\n1 0 2\n0 1 2\n3 0 1 2\n");
  ASSERT_EQ(
      raytube("run case.toml -o uneven --quiet " + settings +
              " --set 'look.phi_deg=[0,1,3,4]' --set 'look.theta_deg=[0,10,20]' --set 'target.mesh=[\"mesh.off\",\"other.off\"]'")
          .code,
      0);
  EXPECT_EQ(raytube("report uneven --quiet").code, 0);
  EXPECT_THAT(page("uneven/report.html"),
              AllOf(HasSubstr("\"traced\":3"), HasSubstr("Curves by mechanism: "), HasSubstr("Map: rcs.csv: azimuth"),
                    HasSubstr("are not in even steps"), HasSubstr("Range profiles: rcs.csv has one frequency")));
}

TEST_F(Report, HasTheCentresThatAreThere) {
  EXPECT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_THAT(page(), HasSubstr("Scattering centres: there is no centres.csv; raytube centres CASE.toml"));
  ASSERT_EQ(raytube("centres case.toml -o kept --quiet --look 2 " + settings).code, 0);
  EXPECT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_THAT(page(),
              AllOf(HasSubstr("\"look\":2,\"ghz\":10.0"), HasSubstr("\"mechanism\":[\"bounce_1\""), HasSubstr("\"doubt\":\"\"")));
  scratch.write("large.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n");
  ASSERT_EQ(raytube("centres case.toml -o kept --quiet --look 2 " + settings + " --set target.mesh=large.off").code, 0);
  EXPECT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_THAT(page(), HasSubstr("centres.csv may be of other settings"));
  ASSERT_EQ(raytube("centres case.toml -o kept --quiet " + settings + " --set frequency.ghz=9").code, 0);
  EXPECT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_THAT(page(), HasSubstr("at 9 GHz, which the result does not have"));
  scratch.write("kept/centres.csv", "centre,x_m\n");
  EXPECT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_THAT(page(), HasSubstr("centres.csv: does not begin as raytube centres writes it; run raytube centres again"));
}

TEST_F(Report, HasWhatRoughSurfacesScatter) {
  EXPECT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_THAT(page(), HasSubstr("\"incoherent\":null"));
  scratch.write("rough.toml", "[target]\nmesh = \"mesh.off\"\nunit = \"mm\"\nmaterial = \"rock\"\n" + frequency + look +
                                  "[materials.rock]\nkind = \"dielectric\"\neps_r = 4\nroughness_rms_mm = 1\n");
  ASSERT_EQ(raytube("run rough.toml -o kept --quiet --set output.incoherent=true " + settings).code, 0);
  EXPECT_EQ(raytube("report kept --quiet").code, 0);
  EXPECT_THAT(page(), HasSubstr("\"incoherent\":[\""));
  const std::string table = text_of(scratch / "kept/incoherent.csv");
  scratch.write("kept/incoherent.csv", table.substr(0, table.rfind('\n', table.size() - 2) + 1));
  expect_refused("report kept", "incoherent.csv: has 4 rows, the result beside it 5; run the case again, or delete the file");
}

// It would tell of results that are no longer there; what somebody has made of it is theirs.
TEST_F(Report, GoesWithTheResultsThatItTellsOf) {
  ASSERT_EQ(raytube("report kept --quiet").code, 0);
  ASSERT_EQ(raytube("run case.toml -o kept --quiet " + settings).code, 0);
  EXPECT_FALSE(std::filesystem::exists(scratch / "kept/report.html"));
  scratch.write("kept/report.html", "mine");
  ASSERT_EQ(raytube("run case.toml -o kept --quiet " + settings).code, 0);
  EXPECT_EQ(page(), "mine");
}

TEST_F(Report, FoldersWithoutAResultAreRefused) {
  expect_refused("report nowhere", "nowhere: is not there; give the folder of a run");
  expect_refused("report .", "holds neither rcs.csv nor rcs.nc");
  expect_refused("report mesh.off", "mesh.off");
  expect_refused("report kept/channels.csv", "its columns are not those of rcs.csv");
  expect_refused("report kept --looks 5", "--looks 5: kept/rcs.csv has 5 look(s), counted from 0");
  expect_refused("report kept --looks 0,1,2,3", "--looks: a report shows 3 at most; leave out 1");
  expect_refused("report kept -o page.txt", "-o page.txt: a report is a page of HTML; name a file that ends in .html");
  expect_refused("report kept -o nowhere.html/", "-o nowhere.html/: a report is a page of HTML");
  scratch.write("kept/run.json", "{ \"case\": ");
  expect_refused("report kept", "run.json: is no JSON as a run writes it");
}

TEST_F(Report, WhatIsNotOfTheRunIsRefused) {
  const std::string parts = text_of(scratch / "kept/parts.csv");
  scratch.write("kept/parts.csv", parts.substr(0, parts.rfind('\n', parts.size() - 2) + 1));
  expect_refused("report kept", "parts.csv: has 4 rows, the result beside it 5");
  scratch.write("kept/parts.csv", parts);
  ASSERT_EQ(raytube("report kept --quiet").code, 0);
  scratch.write("kept/report.html", "mine");
  expect_refused("report kept", "report.html");
  scratch.write("mesh.off", plate + "\n");
  expect_refused("report kept -o new.html --looks 0", "has no target: its case or mesh is not where the run had it");
}

}  // namespace
}  // namespace raytube
