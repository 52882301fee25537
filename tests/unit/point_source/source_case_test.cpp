// The case file of `raytube sources`: what it says, its defaults, and a sentence for everything it must not say.
#include "point_source/source_case.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string part = "[[scene.parts]]\nname = \"screen\"\nmesh = \"m.off\"\nunit = \"mm\"\nsurface = \"pec\"\n";
const std::string source = "[source]\npoint_m = [1, 2, 3]\nrays = 1000\ncounted = \"screen\"\n";

SourceCase read_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_source_case(Scratch().write("case.toml", text), overrides);
}

std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_text(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SourceCase, Defaults) {
  const SourceCase c = read_text(part + source);
  EXPECT_EQ(c.title, "case");
  ASSERT_EQ(c.parts.size(), 1u);
  EXPECT_EQ(c.parts[0].mesh_file.filename(), "m.off");
  EXPECT_EQ(c.parts[0].metres_per_unit, 1e-3);
  EXPECT_EQ(c.points, std::vector{dvec3(1, 2, 3)});
  EXPECT_EQ(c.models.size(), 6u);
  EXPECT_THAT(c.rays, ElementsAre(1000u));
  EXPECT_EQ(c.seed, 1u);
  EXPECT_EQ(c.wall, 0);
  EXPECT_EQ(c.max_reflections, 10);
  EXPECT_EQ(c.counted, 0u);
  EXPECT_FALSE(c.box);
  EXPECT_TRUE(c.plots);
}

TEST(SourceCase, EverythingGiven) {
  const std::string second = "[[scene.parts]]\nname = \"wall\"\nmesh = \"w.stl\"\nunit = \"m\"\nsurface = \"absorber\"\n";
  const SourceCase c =
      read_text("title = \"t\"\n[scene]\nbox_m = [[-1, -2, -3], [1, 2, 3]]\n" + part + second +
                "[source]\npoint_m = [[0, 0, 0], [0.5, 0, 0]]\nmodels = [\"geometry\", \"random\"]\nrays = [500, 100]\n"
                "seed = 7\nwall = \"+y\"\nmax_reflections = 0\ncounted = \"wall\"\n[output]\nplots = false\n");
  EXPECT_EQ(c.box->low, dvec3(-1, -2, -3));
  EXPECT_EQ(c.parts[1].surface, RaySurface::absorber);
  EXPECT_EQ(c.points.size(), 2u);
  EXPECT_THAT(c.models, ElementsAre(LaunchModel::geometry, LaunchModel::random));
  EXPECT_THAT(c.rays, ElementsAre(100u, 500u));
  EXPECT_EQ(c.seed, 7u);
  EXPECT_EQ(c.wall, 3);
  EXPECT_EQ(c.max_reflections, 0);
  EXPECT_EQ(c.counted, 1u);
  EXPECT_FALSE(c.plots);
}

TEST(SourceCase, OverridesReachTheSource) {
  EXPECT_THAT(read_text(part + source, {"source.rays=[1,2]", "source.models=angles"}).rays, ElementsAre(1u, 2u));
}

TEST(SourceCase, BadInputNamesPlaceAndRemedy) {
  const auto says = [](const std::string& text, const std::string& sentence) {
    EXPECT_THAT(complaint(text), HasSubstr(sentence));
  };
  says(source, "no scene; add a [[scene.parts]]");
  says(part, "source.point_m is missing");
  says(part + "[source]\npoint_m = [0, 0, 0]\ncounted = \"screen\"\n", "source.rays is missing");
  says(part + "[source]\npoint_m = [0, 0]\nrays = 1\ncounted = \"screen\"\n", "source.point_m must be a list of three numbers");
  says(part + "[source]\npoint_m = [[0, 0, 0], [1]]\nrays = 1\ncounted = \"screen\"\n", "every entry of source.point_m");
  says(part + "[source]\npoint_m = [0, 0, 0]\nrays = 1\ncounted = \"scren\"\n",
       "\"scren\" is not a part of the scene; write screen");
  says(part + source + "seeds = 1\n", "line 10: unknown key \"source.seeds\"; did you mean \"source.seed\"?");
  says(part + "units = 1\n" + source, "unknown key \"scene.parts.units\"; did you mean \"scene.parts.unit\"?");
  says(part + source + "[target]\nmesh = \"a\"\n", "[target] belongs to a case for raytube run; run it with that command");
  says(part + source + "[materials.a]\nkind = \"pec\"\n", "[materials] belongs to a case for raytube run");
  says("[scene]\nparts = 3\n" + source, "scene.parts must be a list");
  says("[scene]\nparts = [3]\n" + source, "every entry of scene.parts must be a section");
  says("source = 3\n" + part, "source must be a section");
  says(part + part + source, "scene.parts.name \"screen\" is given twice");
  says("[[scene.parts]]\nname = \"a b\"\n" + source, "must be a word without blanks");
  says("[[scene.parts]]\nname = \"a\"\nmesh = \"m.off\"\nunit = \"m\"\n" + source, "scene.parts.surface is missing");
  says("[[scene.parts]]\nname = \"a\"\nmesh = \"m.off\"\nunit = \"mile\"\n" + source,
       "scene.parts.unit \"mile\" is unknown; write \"m\"");
  says("[[scene.parts]]\nname = \"a\"\nmesh = \"m.off\"\nunit = \"m\"\nsurface = \"wood\"\n" + source,
       "\"wood\" is unknown; write \"pec\" or");
  says(part + source + "models = [\"sobol\"]\n", "source.models \"sobol\" is unknown; write \"random\", \"angles\"");
  says(part + source + "models = [\"angles\", \"angles\"]\n", "names \"angles\" twice");
  says(part + source + "models = []\n", "source.models is an empty list");
  says(part + source + "seed = -1\n", "source.seed must be a whole number from 0 to 2^53");
  says(part + source + "wall = \"x\"\n", "source.wall \"x\" is unknown; write \"-x\", \"+x\"");
  says(part + source + "max_reflections = 1.5\n", "source.max_reflections must be a whole number");
  says("[scene]\nbox_m = [[0, 0, 0], [1, 1, 0]]\n" + part + source, "scene.box_m must have its lower corner first");
  says("[scene]\nbox_m = [0, 1]\n" + part + source, "a corner of scene.box_m must be a list of three numbers");
  EXPECT_THAT(complaint(part + source, {"source.rays=0"}), HasSubstr("source.rays must be a whole number from 1"));
  EXPECT_THAT(complaint(part + source, {"source.rays=[5,5]"}), HasSubstr("gives a number twice"));
}

}  // namespace
}  // namespace raytube
