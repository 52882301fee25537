// What a case says about materials: what it means, what it leaves out, and where on the target it is.
#include "case/target.h"
#include "unit/case_text.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string in_facets = "[target.facets]\n";

/// A case of one material, which everything is made of.
std::string made_of(const std::string& keys) {
  return "[target]\nmesh = \"m.obj\"\nunit = \"mm\"\nmaterial = \"it\"\n" + frequency + look + "[materials.it]\n" + keys;
}

Material only_material(const std::string& keys) {
  const Case c = read_text(made_of(keys));
  EXPECT_EQ(c.sweep.materials.size(), 1u);
  return c.sweep.materials.at(0);
}

Medium only_medium(const std::string& keys) { return only_material("kind = \"dielectric\"\n" + keys).layers.at(0).at(0).medium; }

TEST(CaseMaterials, NoneByDefault) {
  const Case c = read_text(smallest);
  EXPECT_TRUE(c.sweep.materials.empty());
  EXPECT_EQ(c.assignment.elsewhere, "pec");
  EXPECT_THAT(resolved_case_json(c), AllOf(HasSubstr("\"material\": \"pec\""), Not(HasSubstr("materials")),
                                           Not(HasSubstr("parts")), Not(HasSubstr("facets"))));
}

TEST(CaseMaterials, AHalfSpaceIsAMediumByItsLosses) {
  const Medium glass = only_medium("eps_r = [6.5, 0.1]\nmu_r = [1.5, 0.25]\n");
  EXPECT_EQ(glass.permittivity, Complex(6.5, -0.1));
  EXPECT_EQ(glass.permeability, Complex(1.5, -0.25));
  EXPECT_EQ(only_medium("eps_r = 4\n").permittivity, Complex(4.0, 0.0));
  EXPECT_EQ(only_medium("eps_r = 4\n").permeability, Complex(1.0, 0.0));
  EXPECT_EQ(only_medium("eps_r = 4\nloss_tangent = 0.01\n").permittivity, Complex(4.0, -0.04));
}

TEST(CaseMaterials, ConductivityLosesMoreAtLowFrequencies) {
  const std::string copper = made_of("kind = \"dielectric\"\neps_r = 1\nconductivity_s_per_m = 5.8e7\n");
  const Case c = read_text(copper, {"frequency.ghz=[1, 10]"});
  constexpr double eta = 376.730313668;  // [ohm], CODATA 2018
  for (std::size_t i = 0; i < 2; ++i) {
    const Complex eps = c.sweep.materials.at(0).layers.at(i).at(0).medium.permittivity;
    // sigma / (omega eps_0) = sigma eta lambda / (2 pi); eta has 12 digits, and one bit of rounding is far less.
    const double loss = 5.8e7 * eta * wavelength(c.sweep.frequencies[i]) / (2.0 * pi);
    EXPECT_EQ(eps.real(), 1.0);
    EXPECT_NEAR(eps.imag() / -loss, 1.0, 1e-11);
  }
}

TEST(CaseMaterials, EachKindIsWhatItSays) {
  EXPECT_EQ(only_material("kind = \"dielectric\"\neps_r = 3\n").kind, MaterialKind::half_space);
  EXPECT_EQ(only_material("kind = \"absorber\"\n").kind, MaterialKind::absorber);
  const Material coat = only_material("kind = \"coated\"\nthickness_mm = 4.0\neps_r = 3\nroughness_rms_mm = 0.05\n");
  EXPECT_EQ(coat.kind, MaterialKind::coated);
  EXPECT_EQ(coat.layers.at(0).at(0).thickness, 0.004);
  EXPECT_EQ(coat.roughness, 0.05e-3);
  EXPECT_FALSE(coat.transmits());
  EXPECT_EQ(only_material("kind = \"sheet\"\nthickness_mm = 4\neps_r = 3\n").kind, MaterialKind::sheet);
  const Material film = only_material("kind = \"sheet\"\nresistance_ohm = 188.4\n");
  EXPECT_EQ(film.kind, MaterialKind::thin_sheet);
  EXPECT_EQ(film.resistance, 188.4);
  EXPECT_TRUE(std::isinf(film.conductance));
  EXPECT_EQ(only_material("kind = \"sheet\"\nconductance_s = 0.001\n").conductance, 0.001);
}

TEST(CaseMaterials, LayersKeepTheirOrderAtEveryFrequency) {
  const Case c =
      read_text(made_of("kind = \"sheet\"\nlayers = [ { thickness_mm = 2, eps_r = 4 }, { thickness_mm = 5, eps_r = [2, 1], "
                        "mu_r = 3 } ]\n"),
                {"frequency.ghz=[1, 2, 3]"});
  ASSERT_EQ(c.sweep.materials.at(0).layers.size(), 3u);
  for (const std::vector<Layer>& layers : c.sweep.materials[0].layers) {
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].thickness, 0.002);
    EXPECT_EQ(layers[0].medium.permittivity, 4.0);
    EXPECT_EQ(layers[1].thickness, 0.005);
    EXPECT_EQ(layers[1].medium.permittivity, Complex(2, -1));
    EXPECT_EQ(layers[1].medium.permeability, 3.0);
  }
}

TEST(CaseMaterials, ARoughConductorIsAMaterialASmoothOneIsNone) {
  EXPECT_EQ(only_material("kind = \"pec\"\nroughness_rms_mm = 0.1\n").kind, MaterialKind::conductor);
  EXPECT_TRUE(read_text(made_of("kind = \"pec\"\n")).sweep.materials.empty());
}

TEST(CaseMaterials, OnlyThoseOfUseAreSolved) {
  const std::string unused = "[materials.a]\nkind = \"coated\"\nthickness_mm = 1\ntable_csv = \"not_there.csv\"\n";
  const Case c = read_text(made_of("kind = \"dielectric\"\neps_r = 2\n") + unused, {"target.parts.wing=absorber"});
  ASSERT_EQ(c.sweep.materials.size(), 2u);
  EXPECT_EQ(c.sweep.materials[0].name, "it");
  EXPECT_EQ(c.sweep.materials[1].name, "absorber");
  EXPECT_EQ(c.sweep.materials[1].kind, MaterialKind::absorber);
  EXPECT_EQ(c.materials.size(), 2u);
}

TEST(CaseMaterials, OverridesReachEveryKey) {
  const Case c = read_text(made_of("kind = \"dielectric\"\neps_r = 2\n"),
                           {"materials.it.eps_r=4", "materials.pane.kind=sheet", "materials.pane.resistance_ohm=100",
                            "target.parts.wing=pane", "target.parts.\"m.obj\"=absorber", "target.facets.pane=[3, [0, 1]]"});
  ASSERT_EQ(c.sweep.materials.size(), 3u);
  EXPECT_EQ(c.sweep.materials[0].layers.at(0).at(0).medium.permittivity, 4.0);
  EXPECT_EQ(c.sweep.materials[1].resistance, 100.0);
  ASSERT_EQ(c.assignment.facets.size(), 2u);
  EXPECT_EQ(c.assignment.facets[0].last, 1u);
  EXPECT_EQ(c.assignment.facets[1].first, 3u);
}

TEST(CaseMaterials, ResolvedCaseShowsEveryDefault) {
  const std::string json = resolved_case_json(read_text(
      made_of("kind = \"dielectric\"\neps_r = 2\n") + "[materials.film]\nkind = \"sheet\"\nresistance_ohm = "
                                                      "5\n[materials.pane]\nkind = \"sheet\"\nlayers = [ { thickness_mm = "
                                                      "2, eps_r = 4, loss_tangent = 0.5 }, { thickness_mm = 3, eps_r = 5 } ]\n",
      {"target.parts.wing=film", "target.facets.film=[2, 1, [5, 7], [6, 9]]", "target.mesh=[\"a.stl\", \"b.stl\"]"}));
  for (const char* part : {"\"material\": \"it\"", "\"wing\": \"film\"", "\"roughness_rms_mm\": 0.0", "\"resistance_ohm\": 5.0",
                           "\"loss_tangent\": 0.5", "\"thickness_mm\": 3.0", "\"kind\": \"sheet\""})
    EXPECT_THAT(json, HasSubstr(part));
}

std::string value_of(const Case& c, const std::string& key) {
  for (const auto& [name, value] : numerical_keys(c))
    if (name == key) return value;
  return "";
}

TEST(CaseMaterials, AmplitudesDependOnAllOfThem) {
  const Case c =
      read_text(made_of("kind = \"dielectric\"\neps_r = 2\n"),
                {"target.parts.wing=absorber", "target.facets.it=[2, 1, [5, 7], [6, 9]]", "target.mesh=[\"a.stl\", \"b.stl\"]"});
  EXPECT_EQ(value_of(c, "materials.it"),
            "{\"kind\":\"dielectric\",\"eps_r\":[2.0,0.0],\"mu_r\":[1.0,0.0],\"roughness_rms_mm\":0.0}");
  EXPECT_EQ(value_of(c, "target.material"), "\"it\"");
  EXPECT_EQ(value_of(c, "target.parts"), "{\"wing\":\"absorber\"}");
  EXPECT_EQ(value_of(c, "target.facets"), "{\"it\":[[1,2],[5,9]]}");
  EXPECT_EQ(value_of(c, "target.mesh"), "[\"a.stl\",\"b.stl\"]");
}

class CaseTables : public ::testing::Test {
 protected:
  Case read(const std::string& table, const std::string& ghz, const std::string& more = "") const {
    scratch.write("glass.csv", table);
    return read_case(scratch.write("case.toml", made_of("kind = \"dielectric\"\ntable_csv = \"glass.csv\"\n" + more)),
                     {"frequency.ghz=" + ghz});
  }

  std::string complaint(const std::string& table, const std::string& ghz = "10") const {
    try {
      read(table, ghz);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  Scratch scratch;
};

TEST_F(CaseTables, AreLinearBetweenTheirRows) {
  const Case c = read("freq_ghz,eps_real,eps_loss\n8.1,4,0.5\n10.1,6,0.25\n20.1,6,0\n", "[8.1, 8.6, 10.1, 20.1]");
  const auto eps = [&](std::size_t i) { return c.sweep.materials.at(0).layers.at(i).at(0).medium.permittivity; };
  EXPECT_EQ(eps(0), Complex(4, -0.5));
  EXPECT_NEAR(std::abs(eps(1) - Complex(4.5, -0.4375)), 0.0, 1e-14);  // rounding of the share 1/4
  EXPECT_EQ(eps(2), Complex(6, -0.25));
  EXPECT_EQ(eps(3), Complex(6, 0));
  EXPECT_EQ(c.sweep.materials[0].layers[0][0].medium.permeability, 1.0);
}

TEST_F(CaseTables, MayHavePermeability) {
  const Case c = read("freq_ghz;eps_real;eps_loss;mu_real;mu_loss\n1;4;0.5;2;1\n3;4;0.5;1;0\n", "2");
  EXPECT_EQ(c.sweep.materials.at(0).layers.at(0).at(0).medium.permeability, Complex(1.5, -0.5));
}

TEST_F(CaseTables, AreInputsOfTheCase) {
  const auto inputs = input_files(read("freq_ghz,eps_real,eps_loss\n1,4,0\n20,6,0\n", "10"));
  ASSERT_EQ(inputs.size(), 3u);
  EXPECT_EQ(inputs[1].first, "target.mesh");
  EXPECT_EQ(inputs[2].first, "table_csv");
  EXPECT_EQ(inputs[2].second, scratch / "glass.csv");
}

TEST_F(CaseTables, BlameFrequenciesFromTheCommandLine) {
  const auto file = scratch.write("case.toml", made_of("kind = \"dielectric\"\ntable_csv = \"glass.csv\"\n"));
  scratch.write("glass.csv", "freq_ghz,eps_real,eps_loss\n1,4,0\n20,6,0\n");
  const auto says = [&](const std::vector<std::string>& overrides) {
    try {
      read_case(file, overrides);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(says({"frequency.ghz=10"}), "");
  EXPECT_THAT(says({"frequency.ghz=30"}),
              StartsWith("--set frequency.ghz=30: materials.it.table_csv \"glass.csv\" goes from 1 to"));
  scratch.write("glass.csv", "freq_ghz,eps_real,eps_loss\n1,4,0\n9,6,0\n");
  EXPECT_THAT(says({}), HasSubstr("case.toml, line 12: materials.it.table_csv \"glass.csv\" goes from 1 to 9 GHz"));
  EXPECT_THAT(says({"frequency.ghz=30", "materials.it.table_csv=\"none.csv\""}), StartsWith("--set materials.it.table_csv="));
}

TEST_F(CaseTables, AreRefusedWithTheLine) {
  const std::string header = "freq_ghz,eps_real,eps_loss\n";
  EXPECT_THAT(complaint(header + "1,4,0\n9.5,5,0\n"),
              HasSubstr("materials.it.table_csv \"glass.csv\" goes from 1 to 9.5 GHz, but frequency.ghz contains 10"));
  EXPECT_THAT(complaint(header + "11,4,0\n12,5,0\n"), HasSubstr("goes from 11 to 12 GHz"));
  EXPECT_THAT(complaint(header + "1,4,0\n20,5,0\n20,5,0\n"), HasSubstr("glass.csv, line 4: freq_ghz must ascend"));
  EXPECT_THAT(complaint(header + "1,4,0\n"), HasSubstr("glass.csv: a table of a medium needs at least two rows"));
  EXPECT_THAT(complaint("freq_ghz,eps\n1,4\n2,4\n"),
              HasSubstr("glass.csv: the header must be \"freq_ghz,eps_real,eps_loss\" or"));
  EXPECT_THAT(
      complaint(header + "1,4,0\n20,5,-1\n"),
      HasSubstr("glass.csv, line 3: eps_loss has a gain: in eps_r = eps' - j eps'' (e^{+jwt}) losses are not below 0; write 1"));
  EXPECT_THAT(complaint(header + "1,0,1\n20,5,1\n"), HasSubstr("glass.csv, line 2: eps_real must not be 0"));
  EXPECT_THAT(complaint(header + "0,4,1\n20,5,1\n"), HasSubstr("line 2: freq_ghz must be greater than 0"));
  EXPECT_THAT(complaint("freq_ghz,eps_real,eps_loss,mu_real,mu_loss\n1,4,0,1,0\n20,5,0,1,-2\n"),
              HasSubstr("line 3: mu_loss has a gain: in mu_r = mu' - j mu'' (e^{+jwt}) losses are not below 0; write 2"));
  // Through 0 between two rows.
  EXPECT_THAT(complaint(header + "5,-1,0\n15,1,0\n"), HasSubstr("eps_r is 0 in size at 10 GHz"));
}

struct Bad {
  const char* keys;
  const char* says;
};

TEST(CaseMaterials, BadMediaNamePlaceAndRemedy) {
  const Bad bad[] = {
      {"thickness_mm = 1\n", ".kind is missing; write \"pec\", \"absorber\", \"dielectric\", \"solid\", \"coated\", \"sheet\""},
      {"kind = \"metal\"\n", ".kind \"metal\" is unknown; write \"pec\", \"absorber\""},
      {"kind = \"dielectric\"\n", ".eps_r is missing; add it, or table_csv or medium in its place"},
      {"kind = \"dielectric\"\neps_r = 2\nthickness_mm = 2\n",
       ".thickness_mm does not belong to kind \"dielectric\"; remove it, or write kind = \"coated\" or \"sheet\""},
      {"kind = \"pec\"\neps_r = 2\n", ".eps_r does not belong to kind \"pec\"; remove it"},
      {"kind = \"absorber\"\nlayers = []\n", ".layers does not belong to kind \"absorber\""},
      {"kind = \"coated\"\nresistance_ohm = 2\n", ".resistance_ohm does not belong to kind \"coated\""},
      {"kind = \"coated\"\neps_r = 2\n", ".thickness_mm is missing; add the thickness"},
      {"kind = \"coated\"\nthickness_mm = 0\neps_r = 2\n", ".thickness_mm must be from 1e-07"},
      {"kind = \"coated\"\nthickness_mm = -1\neps_r = 2\n", ".thickness_mm must be from 1e-07"},
      {"kind = \"coated\"\nthickness_mm = 1e18\neps_r = 2\n", ".thickness_mm must be from 1e-07 to 1e+15"},
      {"kind = \"coated\"\nthickness_mm = 1\nlayers = [ { thickness_mm = 1, eps_r = 2 } ]\n",
       ".thickness_mm cannot be combined with layers; write it inside each layer"},
      {"kind = \"coated\"\neps_r = 1\nlayers = [ { thickness_mm = 1, eps_r = 2 } ]\n",
       ".eps_r cannot be combined with layers; write it"},
      {"kind = \"coated\"\nlayers = []\n", ".layers must be a list of layers"},
      {"kind = \"coated\"\nlayers = [ 3 ]\n", ".layers[0] must be a layer"},
      {"kind = \"coated\"\nlayers = [ { thickness_mm = 1, eps_r = 2 }, { eps_r = 2 } ]\n", ".layers[1].thickness_mm is missing"},
      {"kind = \"coated\"\nlayers = [ { thickness_mm = 1, kind = \"pec\" } ]\n",
       "unknown key \"materials.it.layers[0].kind\"; choose"},
      {"kind = \"sheet\"\nresistance_ohm = -2\n", ".resistance_ohm must be at least 0 (found -2)"},
      {"kind = \"sheet\"\nresistance_ohm = 2\nthickness_mm = 1\n",
       ".thickness_mm cannot be combined with resistance_ohm; remove one"},
      {"kind = \"sheet\"\nconductance_s = 2\nmedium = \"glass\"\n",
       ".medium cannot be combined with conductance_s; remove one of them"},
      {"kind = \"pec\"\nroughness_rms_mm = -2\n", ".roughness_rms_mm must be from 0 to 1e+06 (found -2)"},
      {"kind = \"dielectric\"\neps_r = [2, -0.5]\n",
       ".eps_r has a gain: in eps_r = eps' - j eps'' (e^{+jwt}) losses are not below 0; write [2, 0.5]"},
      {"kind = \"dielectric\"\neps_r = 2\nmu_r = [1, -1]\n", ".mu_r has a gain: in mu_r = mu' - j mu'' (e^{+jwt})"},
      {"kind = \"dielectric\"\neps_r = 2\nloss_tangent = -0.1\n",
       ".loss_tangent is a gain (found -0.1): in eps_r = eps' - j eps'' (e^{+jwt}) losses are not below 0; write 0.1"},
      {"kind = \"dielectric\"\neps_r = 2\nconductivity_s_per_m = -1\n", ".conductivity_s_per_m is a gain (found -1): in eps_r ="},
      {"kind = \"dielectric\"\neps_r = -2\nloss_tangent = 0.1\n", ".loss_tangent needs an eps_r above 0; write"},
      {"kind = \"dielectric\"\neps_r = 0\n", ".eps_r must not be 0; vacuum has 1"},
      {"kind = \"dielectric\"\neps_r = [0, 1]\n", ".eps_r must not be 0"},
      {"kind = \"dielectric\"\neps_r = 1e300\n",
       ".eps_r: eps_r is 1e+300 in size at 10 GHz, which is not a medium's; correct it"},
      {"kind = \"dielectric\"\neps_r = 2\nmu_r = 1e-40\n", "mu_r is 1e-40 in size"},
      {"kind = \"dielectric\"\neps_r = [1, 2, 3]\n", ".eps_r must be a number, or [real part, loss]"},
      {"kind = \"dielectric\"\neps_r = [1, 2]\nloss_tangent = 0.1\n",
       ".loss_tangent cannot be combined with a loss in eps_r; write eps_r = 1"},
      {"kind = \"dielectric\"\neps_r = 2\nloss_tangent = 0.1\nconductivity_s_per_m = 1\n",
       ".conductivity_s_per_m cannot be combined with loss_tangent; remove one of them"},
      {"kind = \"dielectric\"\neps_r = 2\ntable_csv = \"t.csv\"\n",
       ".table_csv cannot be combined with eps_r; remove one of them"},
      {"kind = \"dielectric\"\ntable_csv = \"t.csv\"\nmu_r = 2\n",
       ".mu_r cannot be combined with table_csv, which says it; remove one"},
      {"kind = \"dielectric\"\ntable_csv = \"t.csv\"\n", ".table_csv: "},
      {"kind = \"dielectric\"\ntable_csv = \"\"\n", ".table_csv is empty; give the file"},
      {"kind = \"dielectric\"\nmedium = \"unobtainium\"\n", ".medium \"unobtainium\" is not in the library; write "},
      {"kind = \"dielectric\"\nmedium = \"Glass\"\n", ".medium \"Glass\" is not in the library; write \"glass\""},
      {"kind = \"dielectric\"\neps = 2\n", "unknown key \"materials.it.eps\"; did you mean \"materials.it.eps_r\"?"},
  };
  for (const auto& [keys, says] : bad) {
    const std::string sentence = complaint(made_of(keys));
    EXPECT_THAT(sentence, AllOf(HasSubstr("case.toml, line 1"), HasSubstr("materials.it"), HasSubstr(says))) << keys;
  }
}

TEST(CaseMaterials, BadPlacesNameTheRemedy) {
  const auto says = [](const std::string& keys, const std::string& sentence) {
    EXPECT_THAT(complaint(smallest + "[materials.paint]\nkind = \"absorber\"\n[materials.tar]\nkind = \"absorber\"\n" + keys),
                HasSubstr(sentence));
  };
  says("[target.parts]\nwing = \"pant\"\n",
       "line 14: target.parts.wing \"pant\" is no material; add [materials.pant], or did you mean \"paint\"?");
  says("[target.parts]\nwing = 3\n", "target.parts.wing must be a text");
  says(in_facets + "pant = [1]\n", "target.facets.pant is no material; add [materials.pant], or did you mean \"paint\"?");
  says(in_facets + "paint = 1\n", "target.facets.paint must be a list of facets and ranges");
  says(in_facets + "paint = []\n", "target.facets.paint is an empty list; give at least one facet, or remove it");
  says(in_facets + "paint = [-1]\n", "every facet of target.facets.paint must be a whole number, counted from 0 (found -1)");
  says(in_facets + "paint = [0.5]\n", "whole number, counted from 0 (found 0.5)");
  says(in_facets + "paint = [[3, 1]]\n", "target.facets.paint has the range [3, 1]; write [1, 3]");
  says(in_facets + "paint = [[1, 2, 3]]\n", "has a range that is not [first, last]; write");
  says(in_facets + "paint = [[0, 9]]\ntar = [12, [7, 8]]\n",
       "line 15: target.facets gives facet 7 both to \"paint\" and to \"tar\"; remove it from one of them");
  says("[materials.pec]\nkind = \"pec\"\n", "materials.pec is defined already; choose another name");
  says("[materials.absorber]\nkind = \"absorber\"\n", "materials.absorber is defined already");
  says("[materials]\nglass = 3\n", "line 14: materials.glass must be a section; write [materials.glass]");
  EXPECT_THAT(complaint(smallest, {"materials.glass=3"}),
              HasSubstr("materials.glass must be a section; write [materials.glass]"));
  EXPECT_THAT(complaint(smallest, {"materials=3"}), HasSubstr("materials must be a section; write [materials.NAME]"));
  EXPECT_THAT(complaint(smallest, {"material.glass.kind=pec"}), HasSubstr("did you mean \"materials\""));
  EXPECT_THAT(complaint(smallest, {"target.parts=3"}), HasSubstr("target.parts must be a section; write [target.parts]"));
  EXPECT_THAT(complaint(smallest, {"target.facets=3"}), HasSubstr("target.facets must be a section"));
  EXPECT_THAT(complaint(smallest, {"target.part.a=pec"}), HasSubstr("did you mean \"target.parts\""));
  EXPECT_THAT(complaint(smallest, {"target.mesh=[]"}), HasSubstr("target.mesh is an empty list"));
  EXPECT_THAT(complaint(smallest, {"target.mesh=[\"a.stl\", 3]"}), HasSubstr("entry 2 of target.mesh must be a text"));
}

// Capitals count less than letters.
TEST(CaseMaterials, MediaAndCapitalsAreNoMaterials) {
  const std::string materials = "[materials.GLAZING]\nkind = \"absorber\"\n";
  const auto says = [&](const std::string& name) { return complaint(smallest + materials, {"target.material=" + name}); };
  EXPECT_THAT(says("glass"), HasSubstr("target.material \"glass\" is a medium, not a material; add [materials.glass] with a kind "
                                       "and medium = \"glass\", and name that here"));
  EXPECT_THAT(says("Wood"),
              HasSubstr("\"Wood\" is a medium, not a material; add [materials.wood] with a kind and medium = \"wood\""));
  EXPECT_THAT(says("glazing"), HasSubstr("add [materials.glazing], or did you mean \"GLAZING\"?"));
  EXPECT_THAT(says("PEC"), HasSubstr("did you mean \"pec\"?"));
  EXPECT_THAT(says("glazin"), HasSubstr("did you mean \"GLAZING\"?"));
  EXPECT_THAT(complaint(smallest + "[materials.glass]\nkind = \"absorber\"\n", {"target.material=GLASS"}),
              HasSubstr("did you mean \"glass\"?"));
}

TEST(CaseMaterials, NamesWithDotsNeedQuotes) {
  const std::string in_file = "[target]\nmesh = \"m.stl\"\nunit = \"mm\"\nparts.plate.v2.off = \"absorber\"\n";
  EXPECT_THAT(complaint(in_file + frequency + look),
              HasSubstr("line 4: a name with dots needs quotes; write parts.\"plate.v2.off\" = \"absorber\" under [target]"));
  EXPECT_THAT(complaint(smallest, {"target.parts.plate.off=pec"}),
              HasSubstr("a name with dots needs quotes; write --set 'target.parts.\"plate.off\"=pec'"));
  EXPECT_THAT(complaint(smallest, {"target.parts.plate={}"}), HasSubstr("write --set 'target.parts.\"plate\"=MATERIAL'"));
  EXPECT_EQ(read_text(smallest, {"target.parts.\"plate.off\"=pec"}).assignment.parts.at(0).name, "plate.off");
}

// Whatever is in the file was there before.
TEST(CaseMaterials, ConflictsAreBlamedOnTheCommandLine) {
  const auto blamed = [](const std::string& keys, const std::string& option, const std::string& says) {
    EXPECT_THAT(complaint(made_of(keys), {option}), AllOf(StartsWith("--set " + option + ": "), HasSubstr(says)));
  };
  const std::string coat = "kind = \"coated\"\nthickness_mm = 3\n", body = "kind = \"dielectric\"\n";
  blamed(coat + "eps_r = 2\n", "materials.it.kind=dielectric", "it.thickness_mm does not belong to kind \"dielectric\"");
  blamed(body + "eps_r = 2\n", "materials.it.kind=sheet", "it.thickness_mm is missing");
  blamed("kind = \"absorber\"\n", "materials.it.kind=dielectric", "it.eps_r is missing");
  blamed(coat + "eps_r = 2\n", "materials.it.layers=[{thickness_mm=2,eps_r=3}]",
         "it.thickness_mm cannot be combined with layers");
  blamed("kind = \"sheet\"\nthickness_mm = 3\neps_r = 2\n", "materials.it.resistance_ohm=5",
         "cannot be combined with resistance_ohm");
  blamed(body + "table_csv = \"t.csv\"\n", "materials.it.eps_r=5", "it.table_csv cannot be combined with eps_r");
  blamed(body + "medium = \"glass\"\n", "materials.it.table_csv=\"t.csv\"", "it.medium cannot be combined with table_csv");
  blamed(body + "eps_r = 2\nloss_tangent = 0.1\n", "materials.it.eps_r=[2,1]",
         "it.loss_tangent cannot be combined with a loss in eps_r");
  blamed(body + "eps_r = 2\nloss_tangent = 0.1\n", "materials.it.eps_r=-2", "it.loss_tangent needs an eps_r above 0");
  blamed(body + "mu_r = 2\n", "materials.it.medium=glass", "it.mu_r cannot be combined with medium");
  blamed(body + "medium = \"glass\"\n", "frequency.ghz=200", "materials.it.medium: \"glass\" is known from 0.1 to 100 GHz");
  blamed(body + "eps_r = 2\n[target.facets]\npec = [3]\n", "target.facets.it=[[0,4]]", "target.facets gives facet 3 both to");
  blamed(body + "eps_r = 2\n[edges]\nmaterials = \"fringe\"\n", "edges.method=none", "edges.materials needs edges.method");
  EXPECT_THAT(complaint(made_of(coat + "eps_r = 2\nresistance_ohm = 3\n"), {"tubes.max_bounces=3"}),
              HasSubstr("case.toml, line 14: "));
}

// So are those with other keys.
TEST(CaseMaterials, OtherConflictsAreBlamedOnTheCommandLine) {
  const auto blamed = [](const std::string& keys, const std::string& option, const std::string& says) {
    EXPECT_THAT(complaint(smallest + keys, {option}), AllOf(StartsWith("--set " + option + ": "), HasSubstr(says)));
  };
  blamed("[tubes]\ncurved = \"never\"\n", "tubes.mode=uniform", "tubes.curved needs adaptive tubes");
  blamed("[accuracy]\ntolerance_db = 1\n", "tubes.mode=uniform", "accuracy.tolerance_db needs adaptive tubes");
  blamed("[edges]\nmethod = \"utd\"\nutd_range_m = 9\n", "edges.method=none", "edges.utd_range_m needs edges.method");
  blamed("[output]\nimage_look = 0\n", "edges.method=utd", "output.image_look needs currents");
  blamed("[edges]\nmethod = \"utd\"\nutd_range_m = 9\n", "radar.range_m=9", "remove one of the two");
  blamed("", "look.looks_csv=looks.csv", "look.looks_csv cannot be combined with");
  blamed("", "radar.position_m=[0,0,9]", "[look] cannot be combined with radar.position_m");
}

/// Two files: squares of four groups and a triangle of one solid.
class CaseTargets : public ::testing::Test {
 protected:
  CaseTargets() {
    scratch.write("a.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4\no car\ng door left\nusemtl red\nf 2 5 6 3\n"
                  "g roof\nusemtl blue\nf 1 2 3\n");
    scratch.write("b.stl",
                  "solid pane\nfacet normal 0 0 1\nouter loop\nvertex 0 0 5\nvertex 1 0 5\nvertex 0 1 5\nendloop\nendfacet\n"
                  "endsolid pane\n");
  }

  Case read(const std::string& keys, const std::vector<std::string>& overrides = {}) const {
    return read_case(scratch.write("case.toml", "[target]\nmesh = [\"a.obj\", \"b.stl\"]\nunit = \"m\"\n" + frequency + look +
                                                    "[materials.film]\nkind = \"sheet\"\nresistance_ohm = 9\n[materials.tar]\n"
                                                    "kind = \"dielectric\"\neps_r = 3\n" +
                                                    keys),
                     overrides);
  }

  /// The material of each polygon, by name.
  std::vector<std::string> made_of(const std::string& keys) const {
    const Case c = read(keys);
    PolygonSoup soup = read_polygon_soup(c.mesh_files[0]);
    add_name(soup, c.meshes[0]);
    PolygonSoup second = read_polygon_soup(c.mesh_files[1]);
    add_name(second, c.meshes[1]);
    add_polygons(second, soup);
    assign_materials(soup, c);
    std::vector<std::string> names;
    for (const std::uint32_t material : soup.materials)
      names.push_back(material == no_index ? "pec" : c.sweep.materials[material].name);
    return names;
  }

  std::string complaint(const std::string& keys, const std::vector<std::string>& overrides = {}) const {
    try {
      load_target(read(keys, overrides));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  Scratch scratch;
};

TEST_F(CaseTargets, PerfectConductorsHaveNoMaterials) {
  EXPECT_THAT(made_of(""), ElementsAre());
  EXPECT_THAT(made_of("[target.parts]\nroof = \"pec\"\n"), ElementsAre());
}

TEST_F(CaseTargets, PartsGoByAnyOfTheirNames) {
  EXPECT_THAT(made_of("[target.parts]\nroof = \"tar\"\npane = \"film\"\n"), ElementsAre("pec", "pec", "tar", "film"));
  EXPECT_THAT(made_of("[target.parts]\nleft = \"tar\"\nred = \"tar\"\n"), ElementsAre("pec", "tar", "pec", "pec"));
  EXPECT_THAT(made_of("[target.parts]\ncar = \"absorber\"\n"), ElementsAre("pec", "absorber", "absorber", "pec"));
}

TEST_F(CaseTargets, NumbersTellMoreThanNamesAndTheseMoreThanFiles) {
  EXPECT_THAT(made_of("[target.parts]\n\"a.obj\" = \"tar\"\nroof = \"film\"\n[target.facets]\npec = [0]\nabsorber = [[2, 3]]\n"),
              ElementsAre("pec", "tar", "absorber", "absorber"));
}

TEST_F(CaseTargets, TheMeshHasTheMaterials) {
  const Case c = read("[target.parts]\npane = \"film\"\n");
  const TriangleMesh mesh = load_target(c).mesh;
  int films = 0;
  for (const Patch& patch : mesh.patches) films += patch.material == 0;
  EXPECT_EQ(films, 1);
}

TEST_F(CaseTargets, WhatIsNotThereIsNamed) {
  EXPECT_THAT(complaint("[target.parts]\nrof = \"tar\"\n"),
              HasSubstr("line 16: target.parts.rof is not a name in the mesh; did you mean \"roof\"?"));
  EXPECT_THAT(complaint("[target.facets]\ntar = [[1, 4]]\n"),
              HasSubstr("line 16: target.facets.tar names facet 4, but the mesh has 4, counted from 0; choose among these"));
  EXPECT_THAT(
      complaint("[target.parts]\ndoor = \"tar\"\nred = \"film\"\n"),
      AllOf(HasSubstr("facet 1 of the mesh goes by the names \"door\" and \"red\""), HasSubstr("remove one of them there")));
  EXPECT_THAT(complaint("[target.parts]\nred = \"film\"\n", {"target.parts.door=tar"}),
              StartsWith("--set target.parts.door=tar: facet 1 of the mesh goes by the names \"door\" and \"red\""));
}

}  // namespace
}  // namespace raytube
