// Images through the real program: which files there are, and what they add up to.
#include <complex>

#include "program.h"
#include "run.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

class ImageFiles : public BadInput {
 protected:
  bool has(const std::string& name) const { return fs::exists(scratch / "out" / name); }

  // S of the first row less the sum of the image's cells, relative.
  double missing(const std::string& channel) const {
    const Complex row = Table((scratch / "out/rcs.csv").string()).complex(0, channel);
    const Table image((scratch / "out/image.csv").string());
    Complex sum = 0.0;
    for (std::size_t i = 0; i < image.rows(); ++i) sum += image.complex(i, channel);
    return std::abs(sum - row) / std::abs(row);
  }
};

TEST_F(ImageFiles, OneLookGivesOneImage) {
  EXPECT_EQ(raytube("run case.toml --set frequency.ghz=3000 --set output.image_look=0").code, 0);
  for (const char* name : {"image.csv", "image.png", "image_phase.png", "image_window.png", "image_mesh.vtu"})
    EXPECT_TRUE(has(name));
  EXPECT_FALSE(has("image.png.dots"));
  EXPECT_LE(missing("vv"), 1e-12);  // rounding
  EXPECT_LE(missing("hh"), 1e-12);
  EXPECT_THAT(text_of(scratch / "out/run.json"), HasSubstr("\"image_per_wavelength\": 10.0"));
}

TEST_F(ImageFiles, SeveralLooksAreNumberedAndEarlierImagesGo) {
  const std::string looks = "run case.toml --set output.plots=false --set look.theta_deg=[10,20,30] --set output.image_look=";
  EXPECT_EQ(raytube(looks + "1").code, 0);
  EXPECT_TRUE(has("image.csv"));
  EXPECT_FALSE(has("image.pvd"));
  EXPECT_EQ(raytube(looks + "[2,0,2]").code, 0);
  for (const char* name : {"image_0.csv", "image_0_mesh.vtu", "image_2.csv", "image_2_mesh.vtu"}) EXPECT_TRUE(has(name));
  for (const char* name : {"image.csv", "image_mesh.vtu", "image_1.csv", "image_0.png"}) EXPECT_FALSE(has(name)) << name;
  const std::string series = text_of(scratch / "out/image.pvd");
  EXPECT_THAT(series, HasSubstr("<DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"image_0_mesh.vtu\"/>\n"
                                "<DataSet timestep=\"2\" group=\"\" part=\"0\" file=\"image_2_mesh.vtu\"/>\n</Collection>"));
  EXPECT_EQ(raytube("run case.toml --set output.plots=false").code, 0);
  for (const char* name : {"image_0.csv", "image_2_mesh.vtu", "image.pvd"}) EXPECT_FALSE(has(name)) << name;
}

TEST_F(ImageFiles, WhatCannotBeShownIsRefusedBeforeTheComputation) {
  for (const std::string command : {"run", "check"}) {
    expect_refused(command + " case.toml --set output.image_look=3", "output.image_look 3: the case has 1 direction pair(s)");
    expect_refused(command + " case.toml --set look.theta_deg=90 --set output.image_look=0", "look 0 sees no area of the target");
    expect_refused(command + " case.toml --set output.image_look=0 --set output.image_per_wavelength=1e9", "60300 would fit");
  }
}

}  // namespace
}  // namespace raytube
