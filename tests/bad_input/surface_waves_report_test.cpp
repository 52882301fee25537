// What check tells of waves over curved surfaces.
#include "program.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

class SurfaceWavesReport : public BadInput {
 protected:
  // Of one look at a case of the repository.
  std::string checked(const std::string& name, const std::string& more = "") const {
    const std::string one_look = " --set look.theta_deg=40 --set look.phi_deg=0";
    EXPECT_EQ(raytube("check " RAYTUBE_SOURCE_DIR "/cases/" + name + "/case.toml" + one_look + more).code, 0)
        << text_of(scratch / "stderr.txt");
    return text_of(scratch / "stdout.txt");
  }
};

constexpr const char* name = "\n  waves over curved surfaces  ";

// The side of the cylinder is two triangles for each of its 144 sides.
TEST_F(SurfaceWavesReport, CountsFacets) {
  const std::string on =
      std::string(name) + "auto, in looks where they can change a row by accuracy.tolerance_db: over 288 facets\n";
  EXPECT_THAT(checked("cylinder"), HasSubstr(on));
  EXPECT_THAT(checked("cylinder", " --set surfaces.waves=true"), HasSubstr(std::string(name) + "on: over 288 facets\n"));
  EXPECT_THAT(checked("cylinder", " --set frequency.ghz=94"), HasSubstr(on));
  EXPECT_THAT(checked("cylinder", " --set radar.range_m=10"), HasSubstr(on));
}

TEST_F(SurfaceWavesReport, SaysWhyThereAreNone) {
  const std::string off = std::string(name) + "off: ";
  EXPECT_THAT(checked("cylinder", " --set surfaces.waves=false"), HasSubstr(off + "surfaces.waves is false\n"));
  EXPECT_THAT(checked("cylinder", " --set edges.method=none"), HasSubstr(off + "they need edge currents"));
  EXPECT_THAT(checked("cylinder", " --set tubes.curved=never"), HasSubstr(off + "with tubes.curved = \"never\", or uniform tubes"));
  EXPECT_THAT(checked("powercube"), HasSubstr(off + "no curved surface\n"));
}

TEST_F(SurfaceWavesReport, LeavesOutOtherMaterials) {
  const std::string absorbing = " --set materials.foam.kind=absorber --set target.material=foam";
  EXPECT_THAT(checked("cylinder", absorbing),
              HasSubstr("off: no curved surface is a conductor, coated or bare, or a half-space\n"));
  const std::string rays = " --look 0 --surface-rays " + (scratch / "rays.vtp").string();
  EXPECT_EQ(raytube("trace " RAYTUBE_SOURCE_DIR "/cases/cylinder/case.toml" + absorbing + rays).code, 2);
  EXPECT_THAT(text_of(scratch / "stderr.txt"),
              HasSubstr("no curved surface is a conductor, coated or bare, or a half-space; leave out the option"));
}

}  // namespace
}  // namespace raytube
