// What check and run tell of the materials of a target.
#include <nlohmann/json.hpp>

#include "program.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string no_plots = " --set output.plots=false";

/// Half of the plate is made of a material `it`, which these keys define, half of a conductor.
class MaterialReport : public BadInput {
 protected:
  std::string checked(const std::string& keys, const std::string& words = "") const {
    scratch.write("case.toml", good_case + "[target.facets]\nit = [0]\n[materials.it]\n" + keys);
    EXPECT_EQ(raytube("check case.toml " + words).code, 0) << text_of(scratch / "stderr.txt");
    return text_of(scratch / "stdout.txt");
  }
};

// A quarter of the power is reflected where R = (1 - 3) / (1 + 3), and by a film of half the impedance of vacuum.
TEST_F(MaterialReport, HasLevelsAtNormalIncidence) {
  EXPECT_THAT(checked("kind = \"dielectric\"\neps_r = 9\n"),
              HasSubstr("\nmaterials, at normal incidence and 10 GHz\n  it: 1 triangle, 5e-07 m^2; dielectric, |R| -6.02 dB\n"
                        "  perfect conductor: 1 triangle, 5e-07 m^2\n\n"));
  EXPECT_THAT(checked("kind = \"sheet\"\nresistance_ohm = 188.36515\n"), HasSubstr("; sheet, |R| -6.02 dB, |T| -6.02 dB\n"));
  EXPECT_THAT(checked("kind = \"coated\"\nthickness_mm = 2\neps_r = 4\n"), HasSubstr("; coated, |R| 0.00 dB\n"));
  EXPECT_THAT(checked("kind = \"absorber\"\n"), HasSubstr("; absorber, |R| -inf dB\n"));
}

// exp(-2 (k s)^2), k = 41.917 / m at 2 GHz, which is nearer to the middle than 10.
TEST_F(MaterialReport, IsThatOfTheMiddleOfTheSweep) {
  EXPECT_THAT(checked("kind = \"pec\"\nroughness_rms_mm = 10\n", "--set frequency.ghz=[10,1,2]"),
              AllOf(HasSubstr("materials, at normal incidence and 2 GHz\n"), HasSubstr("; pec, rough, |R| -3.05 dB\n")));
}

TEST_F(MaterialReport, TellsSidesOfASheetThatDiffer) {
  const std::string layers = "kind = \"sheet\"\nlayers = [ { thickness_mm = 1, eps_r = 9 }, { thickness_mm = 2, eps_r = ";
  EXPECT_THAT(checked(layers + "[2, 5] } ]\n"), HasSubstr(" dB from behind), |T| -"));
  EXPECT_THAT(checked(layers + "9 } ]\n"), AllOf(HasSubstr(" dB, |T| -"), Not(HasSubstr("behind"))));
}

TEST_F(MaterialReport, NamesWhatNothingIsMadeOf) {
  const std::string more = "kind = \"absorber\"\n[materials.tar]\nkind = \"absorber\"\n[materials.rust]\nkind = \"pec\"\n";
  EXPECT_THAT(checked(more), HasSubstr(" m^2\n  defined, but not used in [target]: rust, tar\n"));
  EXPECT_THAT(checked(more, "--set 'target.facets={tar=[0], rust=[1]}'"), HasSubstr("not used in [target]: it\n"));
  EXPECT_THAT(
      checked(more, "--set 'target.facets={rust=[1]}'"),
      HasSubstr("\nmaterials\n  perfect conductor: 2 triangles, 1e-06 m^2\n  defined, but not used in [target]: it, tar\n"));
  EXPECT_THAT(checked("kind = \"absorber\"\n"), Not(HasSubstr("nowhere")));
  scratch.write("case.toml", good_case);
  EXPECT_EQ(raytube("check case.toml").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), Not(HasSubstr("\nmaterials\n")));
}

TEST_F(MaterialReport, SaysWhatEdgesOfMaterialsAdd) {
  const std::string keys = "kind = \"dielectric\"\neps_r = 9\n", wedges = "  2 with a face that is not a perfect conductor add ";
  EXPECT_THAT(checked(keys, "--set edges.materials=none"), HasSubstr(wedges + "nothing (edges.materials = \"none\")\n"));
  EXPECT_THAT(checked(keys), HasSubstr("  2 with a face that is not a perfect conductor have edge currents of their own\n"));
  EXPECT_THAT(checked("kind = \"sheet\"\neps_r = 9\nthickness_mm = 90\n"),
              HasSubstr(" add nothing (their currents are unknown, for example those of "));
  EXPECT_THAT(checked(keys, "--set edges.method=none"), Not(HasSubstr("not a perfect conductor add")));
  EXPECT_THAT(checked(keys, "--set 'target.facets={pec=[0]}'"), Not(HasSubstr("not a perfect conductor add")));
}

TEST_F(MaterialReport, ABodyOfSheetsIsClosedButLetsWavesPass) {
  scratch.write("mesh.off",
                "OFF\n8 6 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n"
                "4 0 4 6 2\n4 1 3 7 5\n");
  EXPECT_THAT(checked("kind = \"sheet\"\nresistance_ohm = 9\n"),
              HasSubstr("  component 0: closed, but partly made of sheets: seen from both sides, 12 triangles\n"));
  EXPECT_THAT(checked("kind = \"absorber\"\n"), HasSubstr("  component 0: closed, 12 triangles\n"));
}

const std::string in_one_plane =
    "pairs of facets of different materials lie upon one another in one plane, for example \"film\" and \"pec\" near (0.5, "
    "0.5, 0) m: only one of the two is seen, by their order in the file and by rounding; write kind = \"coated\" for a layer "
    "on a conductor, or leave one of the two out of the mesh";

// A film drawn upon the middle of a plate of 1 m.
TEST_F(MaterialReport, TellsOfASheetDrawnUponAConductor) {
  scratch.write("film.off", "OFF\n3 1 0\n0.4 0.4 0\n0.7 0.4 0\n0.4 0.7 0\n3 0 1 2\n");
  const std::string both =
      " case.toml --set 'target.mesh=[\"film.off\",\"mesh.off\"]' --set target.unit=m --set materials.film.kind=sheet --set "
      "materials.film.resistance_ohm=9" +
      no_plots;
  const std::string drawn = both + " --set 'target.parts.\"film.off\"=film'";
  EXPECT_EQ(raytube("check" + drawn).code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("\n  2 " + in_one_plane + "\n"));
  const Outcome outcome = raytube("run --quiet" + drawn);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.complaint, "raytube: film.off, mesh.off: 2 " + in_one_plane + "\n");
  const auto notes = nlohmann::json::parse(text_of(scratch / "out/run.json"))["mesh"]["notes"];
  EXPECT_THAT(notes.back()["what"], HasSubstr("upon one another in one plane"));
  EXPECT_EQ(notes.back()["count"], 2);
  EXPECT_THAT(raytube("run --quiet" + both).complaint, Not(HasSubstr("in one plane")));
}

// The same corners, so that the second one is left out.
TEST_F(MaterialReport, TellsOfFacetsLeftOutForOthers) {
  const std::string twice = "run case.toml --quiet --set target.unit=m --set 'target.mesh=[\"mesh.off\",\"b.off\"]'" + no_plots;
  scratch.write("b.off", plate);
  EXPECT_EQ(raytube(twice + " --set 'target.parts.\"b.off\"=absorber'").complaint,
            "raytube: mesh.off, b.off: 2 facets are ignored: earlier ones with the same corners are made of another "
            "material; write kind = \"coated\" for a layer on a conductor, or leave one of the two out of the mesh\n");
  EXPECT_EQ(raytube(twice).complaint, "");
}

}  // namespace
}  // namespace raytube
