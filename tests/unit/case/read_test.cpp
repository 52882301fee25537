// What a case file means: every key, every default, every unit.
#include "unit/case_text.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CaseRead, SmallestCaseGetsEveryDefault) {
  const Case c = read_text(smallest);
  EXPECT_EQ(c.title, "m");
  EXPECT_EQ(c.mesh_files.front().filename(), "m.stl");
  EXPECT_EQ(c.mesh_files.front().parent_path(), c.file.parent_path());
  EXPECT_EQ(c.tubes.mode, TubeMode::adaptive);
  EXPECT_TRUE(c.tubes.skip);
  EXPECT_EQ(c.tubes.curved, CurvedSurfaces::convex);
  EXPECT_EQ(c.tubes.tolerance_db, 0.1);
  EXPECT_EQ(c.tubes.model_share, 0.25);
  EXPECT_EQ(c.tubes.max_per_wavelength, 40.0);
  EXPECT_EQ(c.tubes.max_bounces, 8);
  EXPECT_FALSE(c.tubes.up);
  EXPECT_EQ(c.edges.method, EdgeMethod::fringe);
  EXPECT_EQ(c.wedges.min_wedge_angle, 15.0 * degree);
  EXPECT_TRUE(c.plots);
  EXPECT_FALSE(c.sweep.bistatic);
}

TEST(CaseRead, EveryKeyIsTaken) {
  const Case c = read_text(
      "title = \"T\"\n[target]\nmesh = \"sub/m.obj\"\nunit = \"ft\"\nmaterial = \"pec\"\n[frequency]\nghz = [1, 2.5]\n"
      "[look]\ntheta_deg = 30\nphi_deg = 40.5\n[receive]\ntheta_deg = 50\nphi_deg = [60, 70]\n"
      "[tubes]\nmode = \"adaptive\"\nskip = false\nper_wavelength = 12\nmax_bounces = 3\nup = [0, 0, 2.0]\n"
      "[edges]\nmethod = \"none\"\norder = 3\nthin_sheets = false\nmin_wedge_deg = 20\n[output]\nplots = false\n");
  EXPECT_EQ(c.title, "T");
  EXPECT_THAT(c.mesh_files.front().string(), ::testing::EndsWith("/sub/m.obj"));
  EXPECT_EQ(c.metres_per_unit, 0.3048);
  EXPECT_THAT(c.sweep.frequencies, ElementsAre(1e9, 2.5e9));
  ASSERT_EQ(c.sweep.looks.size(), 2u);
  EXPECT_TRUE(c.sweep.bistatic);
  EXPECT_EQ(c.sweep.looks[1].transmit, (Direction{30.0 * degree, 40.5 * degree}));
  EXPECT_EQ(c.sweep.looks[1].receive, (Direction{50.0 * degree, 70.0 * degree}));
  EXPECT_EQ(c.tubes.mode, TubeMode::adaptive);
  EXPECT_FALSE(c.tubes.skip);
  EXPECT_EQ(c.tubes.max_per_wavelength, 12.0);
  EXPECT_EQ(c.tubes.max_bounces, 3);
  EXPECT_EQ(*c.tubes.up, dvec3(0, 0, 2));
  EXPECT_EQ(c.edges.method, EdgeMethod::none);
  EXPECT_EQ(c.edges.order, 3);
  EXPECT_FALSE(c.wedges.thin_plates);
  EXPECT_EQ(c.wedges.min_wedge_angle, 20.0 * degree);
  EXPECT_FALSE(c.plots);
}

TEST(CaseRead, RaysAndTheirRangeAndTheirEcho) {
  const Case c = read_text(smallest, {"edges.method=utd", "edges.utd_range_m=12.5"});
  EXPECT_EQ(c.edges.method, EdgeMethod::utd);
  EXPECT_EQ(c.edges.utd_range, 12.5);
  EXPECT_THAT(resolved_case_json(c), ::testing::HasSubstr("\"utd_range_m\": 12.5"));
  EXPECT_EQ(read_text(smallest, {"edges.method=utd"}).edges.utd_range, 0.0);  // follows from the mesh
}

TEST(CaseRead, AntennasOnACircleAndTheirEcho) {
  const Case c = read_text(smallest, {"radar.range_m=2.5", "radar.beamwidth_deg=[10, 20]", "radar.aim_m=[0, 0, 0.1]"});
  EXPECT_FALSE(c.sweep.looks[0].far());
  EXPECT_EQ(c.sweep.looks[0].transmit_range, 2.5);
  EXPECT_EQ(c.sweep.looks[0].receive_range, 2.5);
  EXPECT_EQ(c.sweep.radar.aim, dvec3(0, 0, 0.1));
  EXPECT_EQ(c.sweep.radar.pattern.azimuth_beamwidth, 10 * degree);
  EXPECT_EQ(c.sweep.radar.pattern.elevation_beamwidth, 20 * degree);
  EXPECT_THAT(resolved_case_json(c), ::testing::HasSubstr("\"range_m\": 2.5"));
  EXPECT_THAT(resolved_case_json(read_text(smallest)), ::testing::Not(::testing::HasSubstr("radar")));
}

TEST(CaseRead, AntennasAtPlacesStandInPlaceOfLooks) {
  const Case c = read_text(target + frequency + "[radar]\nposition_m = [[0, 0, 2], [3, 0, 0]]\nreceive_position_m = [0, 4, 0]\n");
  ASSERT_EQ(c.sweep.looks.size(), 2u);
  EXPECT_TRUE(c.sweep.bistatic);
  EXPECT_EQ(c.sweep.looks[0].transmit, (Direction{0.0, 0.0}));
  EXPECT_EQ(c.sweep.looks[0].transmit_range, 2.0);
  EXPECT_NEAR(c.sweep.looks[1].transmit.theta, pi / 2, 1e-15);
  EXPECT_NEAR(c.sweep.looks[1].receive.phi, pi / 2, 1e-15);
  EXPECT_EQ(c.sweep.looks[1].receive_range, 4.0);
}

// Positions that were turned by hand, the other way round.
TEST(CaseRead, ATurntableIsAListOfPositions) {
  const std::string radar = target + frequency + "[radar]\naim_m = [0.1, 0.2, 0]\nreceive_aim_m = [0, 0.1, 0]\n";
  const Case turned = read_text(radar + "position_m = [3, 0, 1]\nreceive_position_m = [0, 4, 0]\nturntable_deg = [0, 90, -30]\n");
  const double c = std::sqrt(0.75), s = 0.5;
  const std::vector<dvec3> transmit = {{3, 0, 1}, {0, -3, 1}, {3 * c, 3 * s, 1}},
                           receive = {{0, 4, 0}, {4, 0, 0}, {-4 * s, 4 * c, 0}},
                           aims = {{0.1, 0.2, 0}, {0.2, -0.1, 0}, {0.1 * c - 0.2 * s, 0.1 * s + 0.2 * c, 0}};
  ASSERT_EQ(turned.sweep.looks.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const AntennaPair antennas(turned.sweep.looks[i], turned.sweep.radar, dvec3(0.0));
    EXPECT_LT(glm::distance(antennas.transmit.position(), transmit[i]), 1e-14);
    EXPECT_LT(glm::distance(antennas.receive.position(), receive[i]), 1e-14);
    EXPECT_LT(glm::distance(antennas.transmit.axis(), glm::normalize(aims[i] - transmit[i])), 1e-14);
  }
  EXPECT_THAT(resolved_case_json(turned), HasSubstr("\"turntable_deg\": ["));
  const Case circle = read_text(smallest, {"radar.range_m=2", "radar.turntable_deg={start=0,stop=350,step=10}"});
  EXPECT_EQ(circle.sweep.looks.size(), 36u);
  EXPECT_NEAR(circle.sweep.looks[35].transmit.phi, -350 * degree, 1e-12);
}

TEST(CaseRead, Units) {
  const std::pair<const char*, double> factors[] = {{"m", 1.0},   {"cm", 0.01},   {"mm", 0.001},
                                                    {"um", 1e-6}, {"in", 0.0254}, {"ft", 0.3048}};
  for (const auto& [unit, metres] : factors)
    EXPECT_EQ(read_text(smallest, {std::string("target.unit=") + unit}).metres_per_unit, metres) << unit;
}

TEST(CaseRead, AbsoluteMeshPathStays) {
  EXPECT_EQ(read_text(smallest, {"target.mesh=\"/data/../meshes/m.stl\""}).mesh_files.front(), "/meshes/m.stl");
}

TEST(CaseRead, GigahertzGiveTheHertzMeant) {
  EXPECT_THAT(read_text(smallest, {"frequency.ghz=[8.1, 8.3, 8.7, 9.4, 94.0, 0.1]"}).sweep.frequencies,
              ElementsAre(8.1e9, 8.3e9, 8.7e9, 9.4e9, 94e9, 1e8));
}

TEST(CaseRead, MegahertzForGigahertzAreAskedAbout) {
  EXPECT_THAT(read_text(smallest, {"frequency.ghz=[9400, 9000]"}).warnings,
              ElementsAre(HasSubstr("frequency.ghz goes up to 9400 GHz, a wavelength of 0.0319 mm; if megahertz were meant, "
                                    "write 9.4")));
  EXPECT_TRUE(read_text(smallest, {"frequency.ghz=1000"}).warnings.empty());
}

TEST(CaseRead, FrequencyRangeHoldsBothEnds) {
  EXPECT_THAT(read_text(smallest, {"frequency.ghz={start=92, stop=96, count=5}"}).sweep.frequencies,
              ElementsAre(92e9, 93e9, 94e9, 95e9, 96e9));
  EXPECT_THAT(read_text(smallest, {"frequency.ghz={start=92, stop=93, step=0.5}"}).sweep.frequencies,
              ElementsAre(92e9, 92.5e9, 93e9));
  EXPECT_THAT(read_text(smallest, {"frequency.ghz={start=2, stop=2, count=1}"}).sweep.frequencies, ElementsAre(2e9));
  EXPECT_THAT(read_text(smallest, {"frequency.ghz={start=2, stop=1, count=2}"}).sweep.frequencies, ElementsAre(2e9, 1e9));
}

TEST(CaseRead, SteppedAnglesAreTheDecimalsMeant) {
  const std::vector<double> phi = read_text(smallest, {"look.phi_deg={start=-10, stop=10, step=0.1}"}).looks.phi_deg;
  ASSERT_EQ(phi.size(), 201u);
  for (int i = 0; i <= 200; ++i) EXPECT_EQ(phi[i], (i - 100) / 10.0) << i;
  EXPECT_FALSE(std::signbit(phi[100]));
}

TEST(CaseRead, SteppedRangeEndsAtTheLastStepWithinStop) {
  const auto phi = [](const std::string& range) { return read_text(smallest, {"look.phi_deg=" + range}).looks.phi_deg; };
  EXPECT_THAT(phi("{start=0, stop=1, step=0.3}"), ElementsAre(0, 0.3, 0.6, 0.9));
  EXPECT_THAT(phi("{start=1, stop=0, step=-0.5}"), ElementsAre(1, 0.5, 0));
  EXPECT_THAT(phi("{start=5, stop=5, step=1}"), ElementsAre(5));
  EXPECT_THAT(phi("{start=0, stop=1, count=3}"), ElementsAre(0, 0.5, 1));
  EXPECT_THAT(phi("{start=0, stop=0.99999999999, step=0.25}"), ElementsAre(0, 0.25, 0.5, 0.75, 0.99999999999));
}

TEST(CaseRead, ThetaSlowestThenPhiThenReceiver) {
  const Case c =
      read_text(smallest, {"look.theta_deg=[10,20]", "look.phi_deg=[1,2]", "receive.theta_deg=[30,40]", "receive.phi_deg=[3,4]"});
  ASSERT_EQ(c.sweep.looks.size(), 16u);
  const auto is = [&](std::size_t i, double t, double p, double rt, double rp) {
    return c.sweep.looks[i].transmit == Direction{t * degree, p * degree} &&
           c.sweep.looks[i].receive == Direction{rt * degree, rp * degree};
  };
  EXPECT_TRUE(is(0, 10, 1, 30, 3));
  EXPECT_TRUE(is(1, 10, 1, 30, 4));
  EXPECT_TRUE(is(2, 10, 1, 40, 3));
  EXPECT_TRUE(is(4, 10, 2, 30, 3));
  EXPECT_TRUE(is(8, 20, 1, 30, 3));
}

TEST(CaseRead, OverridesTakeTomlOrBareWordsAndMakeSections) {
  const Case c = read_text(
      smallest, {"edges.method=none", "target.unit=\"m\"", "tubes.max_bounces=2", "title=a plain title", "output.plots=false"});
  EXPECT_EQ(c.edges.method, EdgeMethod::none);
  EXPECT_EQ(c.unit, "m");
  EXPECT_EQ(c.tubes.max_bounces, 2);
  EXPECT_EQ(c.title, "a plain title");
  EXPECT_FALSE(c.plots);
}

TEST(CaseRead, OverridesReachIntoRangesAndTheLastOneWins) {
  const std::string text = target + frequency + "[look]\ntheta_deg = 90\nphi_deg = { start = 0, stop = 4, step = 1 }\n";
  EXPECT_THAT(read_text(text, {"look.phi_deg.step=2"}).looks.phi_deg, ElementsAre(0, 2, 4));
  EXPECT_THAT(read_text(text, {"look.phi_deg=7", "look.phi_deg=8"}).looks.phi_deg, ElementsAre(8));
  EXPECT_THAT(read_text(smallest, {"look.phi_deg={start=0,stop=1,step=1}"}).looks.phi_deg, ElementsAre(0, 1));
}

TEST(CaseRead, OverridesAreAppliedBeforeAnythingIsChecked) {
  EXPECT_EQ(read_text(target + look + "[frequency]\nghz = -1\n", {"frequency.ghz=1"}).sweep.frequencies.front(), 1e9);
}

TEST(CaseRead, LookListMonostatic) {
  const Scratch scratch;
  scratch.write("looks.csv", "\xEF\xBB\xBF# comment\ntheta_deg, phi_deg\r\n90, -0.5\r\n\r\n45,+270\r\n");
  const Case c = read_case(scratch.write("case.toml", target + frequency + "[look]\nlooks_csv = \"looks.csv\"\n"));
  ASSERT_EQ(c.sweep.looks.size(), 2u);
  EXPECT_FALSE(c.sweep.bistatic);
  EXPECT_EQ(c.sweep.looks[1].transmit, (Direction{45.0 * degree, 270.0 * degree}));
  EXPECT_EQ(c.sweep.looks[1].transmit, c.sweep.looks[1].receive);
}

TEST(CaseRead, LookListBistatic) {
  const Scratch scratch;
  scratch.write("looks.csv", "theta_deg,phi_deg,rx_theta_deg,rx_phi_deg\n90,0,80,10\n");
  const Case c = read_case(scratch.write("case.toml", target + frequency + "[look]\nlooks_csv = \"looks.csv\"\n"));
  EXPECT_TRUE(c.sweep.bistatic);
  EXPECT_EQ(c.sweep.looks.front().receive, (Direction{80.0 * degree, 10.0 * degree}));
}

TEST(CaseRead, ResolvedCaseShowsEveryDefault) {
  const std::string json = resolved_case_json(read_text(smallest, {"frequency.ghz=9.4"}));
  for (const char* part :
       {"\"title\": \"m\"", "\"unit\": \"mm\"", "\"material\": \"pec\"", "\"ghz\": 9.4", "\"theta_deg\": 90.0",
        "\"mode\": \"adaptive\"", "\"per_wavelength\": 40.0", "\"skip\": true", "\"curved\": \"convex\"", "\"tolerance_db\": 0.1",
        "\"model_share\": 0.25", "\"max_bounces\": 8", "\"method\": \"fringe\"", "\"order\": 3", "\"receiver_shadow\": false",
        "\"thin_sheets\": true", "\"min_wedge_deg\": 15.0", "\"plots\": true"})
    EXPECT_THAT(json, HasSubstr(part));
  EXPECT_EQ(json.find("\"receive\""), std::string::npos);
}

TEST(CaseRead, WhoeverAsksForAToleranceGetsIt) {
  EXPECT_EQ(read_text(smallest, {"accuracy.tolerance_db=0.1"}).tubes.model_share, 0.0);
  EXPECT_EQ(read_text(smallest, {"accuracy.tolerance_db=0.1", "accuracy.model_share=0.5"}).tubes.model_share, 0.5);
  EXPECT_EQ(read_text(smallest, {"accuracy.model_share=0"}).tubes.tolerance_db, 0.1);
}

TEST(CaseRead, UniformTubesHaveADensityAndNoTolerance) {
  const Case c = read_text(smallest, {"tubes.mode=uniform"});
  EXPECT_EQ(c.tubes.per_wavelength, 10.0);
  EXPECT_EQ(resolved_case_json(c).find("tolerance_db"), std::string::npos);
}

TEST(CaseRead, ResolvedCaseKeepsFileNamesRelativeToTheCase) {
  const Scratch scratch;
  scratch.write("looks.csv", "theta_deg,phi_deg\n90,0\n");
  const std::string text =
      "[target]\nmesh = \"sub/../m.stl\"\nunit = \"mm\"\n" + frequency + "[look]\nlooks_csv = \"looks.csv\"\n";
  const std::string json = resolved_case_json(read_case(scratch.write("case.toml", text)));
  EXPECT_THAT(json, HasSubstr("\"mesh\": \"sub/../m.stl\""));
  EXPECT_THAT(json, HasSubstr("\"looks_csv\": \"looks.csv\""));
  EXPECT_EQ(json.find(scratch.folder().string()), std::string::npos);
}

TEST(CaseRead, AzimuthAndElevationAreOtherNamesOfPhiAndTheta) {
  const Case c = read_text(target + frequency +
                           "[look]\nazimuth_deg = { start = -10, stop = 10, step = 10 }\nelevation_deg = [0.1, -90]\n"
                           "[receive]\nazimuth_deg = 5\ntheta_deg = 30\n");
  EXPECT_EQ(c.looks.phi_deg, (std::vector<double>{-10, 0, 10}));
  EXPECT_EQ(c.looks.theta_deg, (std::vector<double>{89.9, 180}));
  EXPECT_EQ(c.looks.rx_phi_deg, std::vector<double>{5});
  EXPECT_EQ(c.looks.rx_theta_deg, std::vector<double>{30});
}

TEST(CaseRead, ListsOfAzimuthAndElevation) {
  const Scratch scratch;
  scratch.write("looks.csv", "azimuth_deg,elevation_deg,rx_azimuth_deg,rx_elevation_deg\n20,10,-30,0\n");
  const Case c = read_case(scratch.write("case.toml", target + frequency + "[look]\nlooks_csv = \"looks.csv\"\n"));
  ASSERT_EQ(c.sweep.looks.size(), 1u);
  EXPECT_TRUE(c.sweep.bistatic);
  EXPECT_DOUBLE_EQ(c.sweep.looks[0].transmit.theta, 80 * degree);
  EXPECT_DOUBLE_EQ(c.sweep.looks[0].transmit.phi, 20 * degree);
  EXPECT_DOUBLE_EQ(c.sweep.looks[0].receive.theta, 90 * degree);
  EXPECT_DOUBLE_EQ(c.sweep.looks[0].receive.phi, -30 * degree);
}

}  // namespace
}  // namespace raytube
