// Every bad case gets a sentence with the place and the remedy.
#include "unit/case_text.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

struct Bad {
  const char* override_text;
  const char* says;
};

const Bad bad_values[] = {
    {"title=3", "title must be a text in double quotes"},
    {"target.mesh=3", "target.mesh must be a text"},
    {"target.mesh=\"\"", "give the file of the mesh"},
    {"target.unit=km", "write \"m\", \"cm\", \"mm\", \"um\", \"in\" or \"ft\""},
    {"target.material=glas", "\"glas\" is no material; add [materials.glas], or choose among pec, absorber"},
    {"target.material=glass", "\"glass\" is a medium, not a material; add [materials.glass] with a kind and medium"},
    {"frequency.ghz=0", "greater than 0 (found 0)"},
    {"frequency.ghz=-2", "greater than 0 (found -2)"},
    {"frequency.ghz=nan", "finite"},
    {"frequency.ghz=inf", "finite"},
    {"frequency.ghz=1e308", "too large"},
    {"frequency.ghz=ten", "a number, a list or { start, stop, step } (or count)"},
    {"frequency.ghz=[]", "at least one number"},
    {"frequency.ghz=[1,\"x\"]", "every entry of frequency.ghz must be a number"},
    {"frequency.ghz={start=1,stop=2}", "has neither step nor count"},
    {"frequency.ghz={start=1,stop=2,count=0}", "at least 1"},
    {"frequency.ghz={start=1,stop=2,count=1}", "count = 2 or more"},
    {"frequency.ghz={start=1,stop=2,count=2.5}", "whole number"},
    {"frequency.ghz=[2,1,2]", "frequency.ghz has 2 twice; give each frequency once"},
    {"frequency.ghz={start=1,stop=2,count=1e7}", "more than the 1000000 allowed"},
    {"look.theta_deg=180.5", "0 to 180 degrees"},
    {"look.elevation_deg=3", "look.elevation_deg and look.theta_deg both give the same angle"},
    {"look.azimuth_deg=3", "look.azimuth_deg and look.phi_deg both give the same angle"},
    {"look.theta_deg=[90,-1]", "found -1"},
    {"look.theta_deg=true", "look.theta_deg must be a number, a list or { start, stop, step } (or count)"},
    {"look.phi_deg={start=0,stop=1,step=0}", "must not be zero"},
    {"look.phi_deg={start=0,stop=1,step=-1}", "write step = 1"},
    {"look.phi_deg={start=0,stop=1e12,step=1}", "1000000 allowed"},
    {"look.phi_deg={start=0,stop=1,count=3,step=0.5}", "look.phi_deg has both a step and a count; leave one of them out"},
    {"look.phi_deg={start=0,stop=1,steps=3}", "write look.phi_deg = { start, stop, step } or { start, stop, count }"},
    {"look.looks_csv=looks.csv", "remove one or the other"},
    {"tubes.mode=fast", "write \"uniform\" or \"adaptive\""},
    {"tubes.per_wavelength=0", "at least 0.001"},
    {"tubes.per_wavelength=-3", "at least 0.001 (found -3)"},
    {"tubes.max_bounces=0", "from 1 to 1000 (found 0)"},
    {"tubes.max_bounces=2.5", "whole number"},
    {"tubes.max_bounces=2000", "from 1 to 1000"},
    {"tubes.up=[0,0]", "three numbers"},
    {"tubes.up=[0,0,0]", "zero vector"},
    {"tubes.curved=yes", "\"yes\" is unknown; write \"never\", \"convex\" or \"always\""},
    {"edges.method=gtd", "is unknown; write \"none\", \"fringe\" or \"utd\""},
    {"edges.utd_range_m=5", "needs edges.method = \"utd\"; currents radiate to infinity, so remove it"},
    {"edges.between_budget=-1", "edges.between_budget must be at least 0"},
    {"edges.order=0", "from 1 to 3"},
    {"edges.order=4", "from 1 to 3"},
    {"edges.method=2", "text"},
    {"edges.min_wedge_deg=180", "less than 180"},
    {"output.plots=yes", "true or false"},
    {"output.image_look=-1", "output.image_look -1: the case has 1 direction pair(s), counted from 0"},
    {"output.image_look=1", "output.image_look 1: the case has 1"},
    {"output.image_look=[0,0.5]", "output.image_look 0.5: the case has 1"},
    {"output.image_look=[]", "at least one direction pair"},
    {"output.image_look=all", "the number of a direction pair or a list"},
    {"output.image_per_wavelength=0", "output.image_per_wavelength must be at least 0.001"},
    {"output.image_per_wavelenth=3", "did you mean \"output.image_per_wavelength\""},

    {"accuracy.tolerance_db=-1", "accuracy.tolerance_db"},
    {"materials.glass=3", "materials.glass must be a section; write [materials.glass]"},
    {"edges.methd=none", "did you mean \"edges.method\""},
    {"mesh=m.stl", "did you mean \"target.mesh\""},
    {"tube.max_bounces=3", "did you mean \"tubes.max_bounces\""},
    {"target.per_wavelength=3", "did you mean \"tubes.per_wavelength\""},
    {"look=3", "look must be a section; write [look]"}};

TEST(CaseErrors, BadValueNamesTheOptionAndTheRemedy) {
  for (const auto& [option, says] : bad_values)
    EXPECT_THAT(complaint(smallest, {option}), AllOf(HasSubstr(std::string("--set ") + option + ": "), HasSubstr(says)));
}

TEST(CaseErrors, UniformTubesAreNeverRefined) {
  const std::string uniform = "tubes.mode=uniform";
  EXPECT_THAT(complaint(smallest, {uniform, "tubes.curved=always"}), HasSubstr("needs adaptive tubes;"));
  EXPECT_THAT(complaint(smallest, {uniform, "accuracy.tolerance_db=1"}), HasSubstr("needs adaptive tubes;"));
}

TEST(CaseErrors, ImagesNeedCurrents) {
  EXPECT_THAT(complaint(smallest, {"edges.method=utd", "output.image_look=0"}), HasSubstr("write \"fringe\" or \"none\" there"));
}

TEST(CaseErrors, RangeOfRaysIsPositive) {
  for (const char* range : {"0", "-3", "nan"})
    EXPECT_THAT(complaint(smallest, {"edges.method=utd", std::string("edges.utd_range_m=") + range}),
                HasSubstr("edges.utd_range_m must be"));
}

TEST(CaseErrors, Antennas) {
  const auto of = [](const std::string& keys) { return complaint(smallest + "[radar]\n" + keys); };
  EXPECT_THAT(of("range_m = 0"), HasSubstr("line 10: radar.range_m must be"));
  EXPECT_THAT(of("aim_m = [0, 0, 1]"), HasSubstr("radar.range_m is missing; give the distance from the mesh's origin in metres"));
  EXPECT_THAT(of("range_m = 3\nreceive_range_m = 2"),
              HasSubstr("radar.receive_range_m needs a receiver of its own; add [receive]"));
  EXPECT_THAT(of("range_m = 3\nreceive_position_m = [1, 0, 0]"), HasSubstr("receive_position_m needs radar.position_m"));
  EXPECT_THAT(of("position_m = [1, 0, 0]"), HasSubstr("[look] cannot be combined with radar.position_m"));
  EXPECT_THAT(of("range_m = 3\nbeamwidth_deg = 0"), HasSubstr("radar.beamwidth_deg must be"));
  EXPECT_THAT(of("range_m = 3\nbeamwidth_deg = [1, 2, 3]"), HasSubstr("must be one angle, or [azimuth, elevation]"));
  EXPECT_THAT(of("range_m = 3\nbeamwidth_deg = 200"), HasSubstr("radar.beamwidth_deg must be from 1e-06 to 180 (found 200)"));
  EXPECT_THAT(of("range_m = 3\npattern_csv = \"none.csv\""), HasSubstr("radar.pattern_csv must name a readable CSV file"));
  EXPECT_THAT(of("range_m = 3\naim_m = [1, 2]"), HasSubstr("radar.aim_m must be a list of three numbers"));
  EXPECT_THAT(of("range_m = 3\n[edges]\nmethod = \"utd\"\nutd_range_m = 3"), HasSubstr("remove one of the two"));
  EXPECT_THAT(complaint(target + frequency + "[radar]\nposition_m = [0, 0, 0]"), HasSubstr("must not be the origin"));
}

TEST(CaseErrors, ACaseOfSourcesIsForAnotherCommand) {
  EXPECT_THAT(complaint("[source]\npoint_m = [0, 0, 1]\n"), HasSubstr("line 1: [source] belongs to a case for raytube sources"));
}

TEST(CaseErrors, NamesFileAndLine) {
  EXPECT_THAT(complaint(smallest + "[tubes]\nper_wavelenght = 3\n"),
              HasSubstr("case.toml, line 10: unknown key \"tubes.per_wavelenght\""));
  EXPECT_THAT(complaint(smallest + "[tubes]\nmax_bounces = -1\n"), HasSubstr("case.toml, line 10: tubes.max_bounces must be"));
}

TEST(CaseErrors, NamesWhatIsMissing) {
  EXPECT_THAT(complaint(target + frequency), HasSubstr("add a [look] section"));
  EXPECT_THAT(complaint(target + look), HasSubstr("frequency.ghz is missing; add ghz ="));
  EXPECT_THAT(complaint(frequency + look), HasSubstr("target.mesh is missing; add mesh ="));
  EXPECT_THAT(complaint("[target]\nmesh = \"m.stl\"\n" + frequency + look),
              HasSubstr("target.unit is missing; add unit = \"mm\""));
  EXPECT_THAT(complaint(target + frequency + "[look]\nphi_deg = 1\n"), HasSubstr("look.theta_deg is missing"));
  EXPECT_THAT(complaint(smallest + "[receive]\ntheta_deg = 1\n"), HasSubstr("receive.phi_deg is missing"));
}

TEST(CaseErrors, BrokenTomlNamesTheLine) {
  EXPECT_THAT(complaint("title = \"a\"\n[target\n"), HasSubstr("case.toml, line 2: not valid TOML"));
  EXPECT_THAT(complaint(target + target), HasSubstr("not valid TOML"));
}

TEST(CaseErrors, MissingFileAndFolder) {
  EXPECT_THROW(read_case("no/such/case.toml"), InputError);
  EXPECT_THROW(read_case(Scratch().folder()), InputError);
}

TEST(CaseErrors, MalformedOverrides) {
  EXPECT_THAT(complaint(smallest, {"tubes"}), HasSubstr("no KEY=VALUE"));
  EXPECT_THAT(complaint(smallest, {"=3"}), HasSubstr("no KEY=VALUE"));
  EXPECT_THAT(complaint(smallest, {"a..b=3"}), HasSubstr("not a dotted key"));
}

TEST(CaseErrors, TooManyRows) {
  EXPECT_THAT(complaint(smallest, {"look.phi_deg={start=0,stop=99999,step=1}", "look.theta_deg={start=0,stop=180,step=0.1}"}),
              HasSubstr("more than the 10000000 allowed; split the sweep"));
}

std::string list_complaint(const std::string& list, const std::string& more = "") {
  const Scratch scratch;
  scratch.write("looks.csv", list);
  try {
    read_case(scratch.write("case.toml", target + frequency + "[look]\nlooks_csv = \"looks.csv\"\n" + more));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CaseErrors, LookLists) {
  EXPECT_THAT(list_complaint("90,0\n"), HasSubstr("looks.csv, line 1: the header must be"));
  EXPECT_THAT(list_complaint("theta_deg,phi_deg\n90,0\n90\n"), HasSubstr("looks.csv, line 3: 1 values where the header names 2"));
  EXPECT_THAT(list_complaint("theta_deg,phi_deg\n90,x\n"), HasSubstr("line 2, column phi_deg: \"x\" is not a finite number"));
  EXPECT_THAT(list_complaint("theta_deg,phi_deg\n90,nan\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(list_complaint("theta_deg,phi_deg\n181,0\n"), HasSubstr("line 2: theta must be from 0 to 180"));
  EXPECT_THAT(list_complaint("theta_deg,phi_deg\n"), HasSubstr("no looks"));
  EXPECT_THAT(list_complaint("theta_deg,phi_deg\n1,2\n", "[receive]\ntheta_deg = 1\nphi_deg = 1\n"),
              HasSubstr("[receive] cannot be combined with"));
  EXPECT_THAT(list_complaint("azimuth_deg,elevation_deg\n0,91\n"), HasSubstr("line 2: elevation_deg must be from -90 to 90"));
  EXPECT_THAT(list_complaint("elevation_deg,azimuth_deg\n0,9\n"), HasSubstr("line 1: the header must be"));
  EXPECT_THAT(complaint(target + frequency + "[look]\nlooks_csv = \"none.csv\"\n"), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace raytube
