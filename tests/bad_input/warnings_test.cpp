// What run and check say of targets too small, steps too wide and the work under way; and the words at the end.
#include <map>
#include <nlohmann/json.hpp>

#include "program.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The plate is 1 mm wide, or with this 1 m: 47 wavelengths along its diagonal.
const std::string metres = " --set target.unit=m --set output.plots=false --set edges.method=none ";
const std::string five_degrees = "--set 'look.phi_deg={start=0,stop=45,step=5}' ";

class Warnings : public BadInput {
 protected:
  std::string output() const { return text_of(scratch / "stdout.txt"); }
  nlohmann::json told() const { return nlohmann::json::parse(text_of(scratch / "out/run.json"))["warnings"]; }
};

TEST_F(Warnings, ATargetUnderThreeWavelengths) {
  const std::string sentence =
      "validity: the target's largest extent, 1.414 mm, is 0.047 wavelengths at 10 GHz, and the methods require 3; "
      "check target.unit, which is \"mm\"; below 636 GHz treat results as approximate, or use a full-wave program";
  EXPECT_EQ(raytube("check case.toml").code, 0);
  EXPECT_THAT(output(), HasSubstr("\nwarnings\n  " + sentence + "\n"));
  const Outcome outcome = raytube("run case.toml --set output.plots=false");
  EXPECT_THAT(outcome.complaint, StartsWith("raytube: " + sentence + "\n"));
  EXPECT_EQ(told(), nlohmann::json::array({sentence}));
  EXPECT_THAT(output(), HasSubstr("warnings           1, above and in run.json\n"));
}

TEST_F(Warnings, QuietKeepsThem) {
  const Outcome outcome = raytube("run case.toml --quiet --set output.plots=false");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("validity: "), Not(HasSubstr("solving"))));
  EXPECT_EQ(output(), "");
}

// At theta 10 degrees the plate of 1 m is wide across phi by its diagonal times sin(10 degrees) at most.
TEST_F(Warnings, StepsTooWideForTheLobes) {
  const Outcome outcome = raytube("run case.toml" + metres + five_degrees);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint,
              HasSubstr("raytube: sampling: steps of 5 deg in phi are too wide for this target's lobes, which require "
                        "1.7 deg or less; take finer steps, or read each row by itself"));
  EXPECT_EQ(told().size(), 1u);
  EXPECT_EQ(raytube("run case.toml" + metres + "--set 'look.phi_deg={start=0,stop=45,step=1.5}'").code, 0);
  EXPECT_EQ(told().size(), 0u);
}

// A target that stays a perfect conductor by a forgotten line is no target of that material.
TEST_F(Warnings, AMaterialOfNothing) {
  const std::string coat = "--set materials.paint.kind=absorber --set look.phi_deg=[0] ";
  const Outcome outcome = raytube("run case.toml" + metres + coat);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint, HasSubstr("raytube: materials.paint: nothing is made of it, so it has no effect; write "
                                           "target.material = \"paint\" or target.parts, or remove it\n"));
  EXPECT_EQ(told().size(), 1u);
  EXPECT_EQ(raytube("run case.toml" + metres + coat + "--set target.material=paint").code, 0);
  EXPECT_EQ(told().size(), 0u);
}

TEST_F(Warnings, FiveDegreesAt94GHz) {
  EXPECT_EQ(raytube("check case.toml" + metres + five_degrees + "--set frequency.ghz=94").code, 0);
  EXPECT_THAT(output(), HasSubstr("steps of 5 deg in phi are too wide for this target's lobes, which require 0.18 deg or less"));
}

TEST_F(Warnings, FrequenciesTooFarApart) {
  EXPECT_EQ(raytube("check case.toml" + metres + "--set look.theta_deg=60 --set 'frequency.ghz={start=10,stop=11,count=5}'").code,
            0);
  EXPECT_THAT(
      output(),
      HasSubstr("steps of 0.25 GHz in frequency are too wide for a range profile: it repeats after 0.6 m, and the target is "
                "0.866 m deep; take steps of 0.17 GHz or less"));
  EXPECT_EQ(
      raytube("check case.toml" + metres + "--set look.theta_deg=60 --set 'frequency.ghz={start=10,stop=11,step=0.125}'").code,
      0);
  EXPECT_THAT(output(), AllOf(HasSubstr("in steps of 0.125 GHz: a range profile resolves 0.133 m and repeats after 1.2 m\n"),
                              HasSubstr("\nwarnings\n  none\n")));
}

TEST_F(Warnings, ARangeThatEndsBeforeItsStop) {
  const std::string early = metres + "--set 'look.phi_deg={start=0,stop=1,step=0.4}' ";
  const std::string says =
      "look.phi_deg: steps of 0.4 from 0 end at 0.8, short of stop = 1; to reach it write count = 4 in the "
      "place of step, or else stop = 0.8";
  EXPECT_THAT(raytube("run case.toml" + early).complaint, HasSubstr(says));
  EXPECT_EQ(told().size(), 1u);
  EXPECT_EQ(raytube("check case.toml" + early).code, 0);
  EXPECT_THAT(output(), HasSubstr(says));
  EXPECT_THAT(raytube("run case.toml" + metres + "--set 'frequency.ghz={start=10,stop=10.1,step=0.2}'").complaint,
              HasSubstr("frequency.ghz: steps of 0.2 from 10 end at 10, short of stop = 10.1; to reach it write count = 2"));
  EXPECT_EQ(raytube("run case.toml" + metres + "--set 'look.phi_deg={start=0,stop=1,step=0.1}'").code, 0);
  EXPECT_EQ(told().size(), 0u);
}

TEST_F(Warnings, AListOfLooksIsNoSweep) {
  scratch.write("looks.csv", "theta_deg,phi_deg\n10,0\n20,30\n45,60\n70,10\n80,80\n");
  scratch.write("listed.toml", target + frequency + "[look]\nlooks_csv = \"looks.csv\"\n");
  EXPECT_EQ(raytube("check listed.toml" + metres).code, 0);
  EXPECT_THAT(output(), HasSubstr("\nwarnings\n  none\n"));
}

TEST_F(Warnings, WithoutATerminalALineSaysWhatIsDone) {
  EXPECT_EQ(raytube("run case.toml --threads 1" + metres).complaint, "raytube: solving 1 look at 1 frequency on 1 thread\n");
  EXPECT_EQ(raytube("run case.toml --quiet" + metres).complaint, "");
  EXPECT_EQ(raytube("converge case.toml --densities 2,3,4" + metres).complaint, "raytube: solving 1 looks at 3 densities\n");
  EXPECT_EQ(raytube("converge case.toml --quiet --densities 2,3,4" + metres).complaint, "");
  EXPECT_EQ(output(), "");
}

TEST_F(Warnings, ABoxWithoutItsTop) {
  const std::string corners = "0 0 0\n30 0 0\n30 30 0\n0 30 0\n0 0 30\n30 0 30\n30 30 30\n0 30 30\n";
  const std::string sides = "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";
  const std::string sentence =
      "open bodies: component 0, 100 % of the surface, is closed except for a hole: 900 cm^2 beside 4500 cm^2 of surface, with a "
      "border of 120 cm round (15, 15, 30) cm; rays enter there, and the inside reflects as the outside does; add the missing "
      "facets in the CAD program, unless the opening is intended, like that of a duct";
  const std::string words = " case.toml --set target.unit=cm --set output.plots=false --set edges.method=none";
  scratch.write("mesh.off", "OFF\n8 5 0\n" + corners + sides);
  EXPECT_EQ(raytube("check" + words).code, 0);
  EXPECT_THAT(output(), HasSubstr("\nwarnings\n  " + sentence + "\n"));
  EXPECT_THAT(raytube("run" + words).complaint, StartsWith("raytube: " + sentence + "\n"));
  EXPECT_EQ(told(), nlohmann::json::array({sentence}));
  scratch.write("mesh.off", "OFF\n8 6 0\n" + corners + sides + "4 4 5 6 7\n");
  EXPECT_EQ(raytube("run" + words).complaint.find("open bodies"), std::string::npos);
  EXPECT_EQ(told().size(), 0u);
}

// A mesh in metres whose coat was given in micrometres.
TEST_F(Warnings, ACoatThickerThanItsPlate) {
  const std::string coat =
      " --set target.material=coat --set materials.coat.kind=coated --set materials.coat.eps_r=4 --set "
      "materials.coat.thickness_mm=";
  EXPECT_EQ(raytube("check case.toml" + metres + coat + "2000").code, 0);
  EXPECT_THAT(output(), HasSubstr("materials: the layers of \"coat\" are 2 m thick, but component 0 round (0.5, 0.5, 0) m is "
                                  "only 1 m wide; check thickness_mm and target.unit"));
  EXPECT_EQ(raytube("check case.toml" + metres + coat + "2").code, 0);
  EXPECT_THAT(output(), HasSubstr("\nwarnings\n  none\n"));
}

// On a plate of 1 m, which has edges but nothing for their waves to meet.
TEST_F(Warnings, EdgeKeysWithoutEffect) {
  const std::string quiet = "check case.toml --set target.unit=m ";
  const std::map<std::string, std::string> reasons = {
      {"--set edges.method=none --set edges.order=2", "order has no effect: edges.method is \"none\"; leave the key out"},
      {"--set edges.method=utd --set edges.thin_sheets=true", "thin_sheets has no effect: edges.method is \"utd\""},
      {"--set edges.between=true", "between has no effect: nothing stands in front of any face of the target"},
      {"--set edges.between=false --set edges.between_budget=9", "between_budget has no effect: edges.between is false"},
      {"--set edges.receiver_shadow=true", "receiver_shadow has no effect: looks are monostatic"}};
  for (const auto& [words, reason] : reasons) {
    EXPECT_EQ(raytube(quiet + words).code, 0) << words;
    EXPECT_THAT(output(), HasSubstr(": edges." + reason));
  }
  for (const std::string words :
       {"--set edges.between=false", "--set edges.order=2", "--set edges.method=none --set edges.receiver_shadow=false",
        "--set edges.min_wedge_deg=20", "--set edges.receiver_shadow=true --set receive.theta_deg=40 --set receive.phi_deg=0"}) {
    EXPECT_EQ(raytube(quiet + words).code, 0) << words;
    EXPECT_THAT(output(), HasSubstr("\nwarnings\n  none\n")) << words;
  }
}

TEST_F(Warnings, EdgeKeysOfTheFileAreToldWithTheirLine) {
  scratch.write("case.toml", good_case + "[edges]\nmethod = \"none\"\norder = 2\n");
  const std::string words = "run case.toml --set output.plots=false --set target.unit=m";
  EXPECT_THAT(
      raytube(words).complaint,
      StartsWith("raytube: case.toml, line 11: edges.order has no effect: edges.method is \"none\"; leave the key out, or "
                 "change that\n"));
  EXPECT_EQ(told().size(), 1u);
  raytube(words + " --set edges.method=none");
  EXPECT_EQ(told().size(), 0u);  // who turns edges off for once means their keys, too
}

TEST_F(Warnings, ConvergeMakesNoImages) {
  const std::string words = "converge case.toml --quiet --densities 2,3,4" + metres;
  EXPECT_EQ(raytube(words + "--set output.image_look=0").complaint,
            "raytube: case.toml: output.image_look has no effect here; use raytube run for images\n");
}

TEST_F(Warnings, TruncatedTubesAreTold) {
  scratch.write("mesh.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n1 0 1\n0 0 1\n0 1 0\n0 1 1\n4 0 1 2 3\n4 0 3 5 4\n");
  const std::string corner = "run case.toml --set look.theta_deg=90 --set look.phi_deg=45" + metres;
  EXPECT_EQ(raytube(corner + "--set tubes.max_bounces=1").code, 0);
  // The opening of the corner is sqrt(2) m^2: 1.5 dBsm.
  EXPECT_THAT(output(), HasSubstr(" after tubes.max_bounces = 1: at most 1.5 dBsm left in a look, counted in the model "
                                  "uncertainty; raise tubes.max_bounces\n"));
  const auto counts = nlohmann::json::parse(text_of(scratch / "out/run.json"))["counts"];
  EXPECT_GT(counts["tubes_cut_at_max_bounces"], 0);
  EXPECT_EQ(counts["tubes_cut_by_width"], 0);
  EXPECT_EQ(counts["tubes_cut_by_number"], 0);
  EXPECT_NEAR(counts["tubes_cut_sigma_m2"]["at_max_bounces"].get<double>(), std::sqrt(2.0), 1e-9);
  EXPECT_EQ(raytube(corner).code, 0);
  EXPECT_THAT(output(), Not(HasSubstr("truncated tubes")));
}

}  // namespace
}  // namespace raytube
