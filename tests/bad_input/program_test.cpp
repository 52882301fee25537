// Bad input of every kind, through the real program: exit code 2, one sentence, nothing left where results belong.
#include "program.h"

#include <sched.h>

#include <nlohmann/json.hpp>

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

TEST_F(BadInput, TheGoodCaseIsGood) {
  const Outcome outcome = raytube("run case.toml --quiet --set target.unit=m --set output.plots=false");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.complaint, "");
  EXPECT_TRUE(fs::exists(scratch / "out/rcs.csv"));
}

TEST_F(BadInput, Mesh) {
  expect_refused("run case.toml --set target.mesh=missing.stl", "missing.stl");
  fs::create_directory(scratch / "folder.stl");
  expect_refused("run case.toml --set target.mesh=folder.stl", "folder.stl");
  scratch.write("empty.stl", "");
  expect_refused("run case.toml --set target.mesh=empty.stl", "empty.stl");
  scratch.write("none.off", "OFF\n0 0 0\n");
  expect_refused("run case.toml --set target.mesh=none.off", "none.off");
  scratch.write("nan.off", "OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n");
  expect_refused("run case.toml --set target.mesh=nan.off", "nan.off");
  scratch.write("index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  expect_refused("run case.toml --set target.mesh=index.off", "index.off");
  scratch.write("line.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n");
  expect_refused("run case.toml --set target.mesh=line.off", "line.off");
  scratch.write("mesh.xyz", "0 0 0\n");
  expect_refused("run case.toml --set target.mesh=mesh.xyz", "mesh.xyz");
}

TEST_F(BadInput, MeshForEveryCommand) {
  expect_refused("check case.toml --set target.mesh=missing.stl", "missing.stl");
  expect_refused("trace case.toml --look 0 --u 0 --v 0 --set target.mesh=missing.stl", "missing.stl");
}

TEST_F(BadInput, SeveralMeshFilesAndMaterials) {
  scratch.write("tile.off", "OFF\n3 1 0\n0 0 5\n1 0 5\n0 1 5\n3 0 1 2\n");
  scratch.write("glass.csv", "freq_ghz,eps_real,eps_loss\n1,4,0\n20,4,0\n");
  const std::string tiled =
      "case.toml --set 'target.mesh=[\"mesh.off\", \"tile.off\"]' --set materials.glass.kind=dielectric "
      "--set materials.glass.table_csv=glass.csv --set 'target.parts.\"tile.off\"=glass' --set output.plots=false";
  EXPECT_EQ(raytube("check " + tiled).code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), AllOf(HasSubstr("mesh.off, tile.off, one unit is"), HasSubstr("glass: 1 triangle"),
                                                     HasSubstr("perfect conductor: 2 triangles")));
  EXPECT_EQ(raytube("trace " + tiled + " --look 0 --u 0 --v 0").code, 0);
  EXPECT_EQ(raytube("run " + tiled).code, 0);
  const auto json = nlohmann::json::parse(text_of(scratch / "out/run.json"));
  EXPECT_EQ(json["mesh"]["sha256"].size(), 2u);
  EXPECT_EQ(json["table_csv_sha256"]["glass.csv"].get<std::string>().size(), 64u);
  EXPECT_EQ(json["case"]["target"]["parts"]["tile.off"], "glass");
}

TEST_F(BadInput, WedgeList) {
  expect_refused("check case.toml --wedges missing/wedges.csv", "--wedges missing/wedges.csv: cannot be written");
  expect_refused("check case.toml --wedges .", "--wedges .: a list of wedges");
}

TEST_F(BadInput, RaysInThePlaceOfCurrentsNameTheirRange) {
  const std::string rays = "case.toml --set edges.method=utd --set output.plots=false --set edges.utd_range_m=";
  expect_refused("run " + rays + "1e-3", "edges.utd_range_m is 0.001 m, but the target reaches 0.00141421 m");
  expect_refused("check " + rays + "1e-3", "edges.utd_range_m is 0.001 m");
  EXPECT_EQ(raytube("check " + rays + "0.5").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"),
              AllOf(HasSubstr("edges.method \"utd\""), HasSubstr("transmitter and receiver 0.5 m from the origin")));
  EXPECT_EQ(raytube("run " + rays + "0.5 --parts").code, 0);
  EXPECT_THAT(text_of(scratch / "out/rcs.csv"), HasSubstr("transmitter and receiver 0.5 m from the origin"));
  EXPECT_THAT(text_of(scratch / "out/run.json"), HasSubstr("\"utd_range_m\": 0.5"));
}

TEST_F(BadInput, DiffractionBetweenSurfaces) {
  expect_refused("run case.toml --set edges.between=1", "edges.between must be true, false or \"auto\"");
  expect_refused("run case.toml --set edges.between=yes", "edges.between must be true, false or \"auto\"");
  expect_refused("run case.toml --set edges.beetween=true", "did you mean \"edges.between\"?");
  EXPECT_EQ(raytube("check case.toml --set edges.between=false").code, 0);
}

TEST_F(BadInput, CaseFile) {
  expect_refused("run missing.toml", "missing.toml: no such file");
  expect_refused("run .", "cannot be read");
  scratch.write("case.toml", "[target\n");
  expect_refused("run case.toml", "case.toml, line 1: not valid TOML");
  scratch.write("case.toml", good_case + "[tubes]\nmax_bounce = 3\n");
  expect_refused("run case.toml", "case.toml, line 10: unknown key \"tubes.max_bounce\"; did you mean \"tubes.max_bounces\"?");
  scratch.write("case.toml", "[target]\nmesh = \"mesh.off\"\n" + frequency + look);
  expect_refused("run case.toml", "target.unit is missing");
}

TEST_F(BadInput, Values) {
  expect_refused("run case.toml --set frequency.ghz=-1", "frequency.ghz must be greater than 0");
  expect_refused("run case.toml --set tubes.per_wavelength=0", "tubes.per_wavelength must be at least 0.001");
  expect_refused("run case.toml --set tubes.mode=uniform --set tubes.per_wavelength=1e12", "tubes.per_wavelength");
  expect_refused("run case.toml --set tubes.max_bounces=many", "tubes.max_bounces must be a number");
  expect_refused("run case.toml --set 'look.phi_deg={start=0,stop=1,step=-1}'", "write step = 1");
  expect_refused("run case.toml --set 'title=\"\\u0007\"' --set look.theta_deg=200", "0 to 180 degrees");
  expect_refused("run case.toml --set 'tubes.mode=\"a\\nb\"'", "tubes.mode");
}

TEST_F(BadInput, OutputFolder) {
  scratch.write("file", "");
  expect_refused("run case.toml -o file", "choose another one with -o DIR");
  expect_refused("run case.toml -o file/out", "choose another one with -o DIR");
  expect_refused("run case.toml -o ''", "-o");
  EXPECT_EQ(text_of(scratch / "file"), "");
}

TEST_F(BadInput, FailureLeavesEarlierResultsAlone) {
  fs::create_directory(scratch / "old");
  scratch.write("old/rcs.csv", "earlier");
  EXPECT_EQ(raytube("run case.toml -o old --set target.mesh=missing.stl").code, 2);
  EXPECT_EQ(text_of(scratch / "old/rcs.csv"), "earlier");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "old"), {}), 1);
}

TEST_F(BadInput, InterruptLeavesNothing) {
  const std::string hours = "--set target.unit=m --set tubes.per_wavelength=100 --set 'look.phi_deg={start=0,stop=90,step=0.01}'";
  const Outcome outcome = raytube("run case.toml " + hours, "timeout --preserve-status -s INT -k 5 0.5 ");
  EXPECT_EQ(outcome.code, 130);
  EXPECT_THAT(outcome.complaint, HasSubstr("interrupted"));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST_F(BadInput, ThreadsAreThoseTheProcessMayUse) {
  cpu_set_t allowed;
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  int processor = 0;
  while (!CPU_ISSET(processor, &allowed)) ++processor;
  EXPECT_EQ(raytube("run case.toml --set output.plots=false", "taskset -c " + std::to_string(processor) + " ").code, 0);
  EXPECT_THAT(text_of(scratch / "out/run.json"), HasSubstr("\"threads\": 1,"));
}

// gnuplot is the longest wait among the files; the stand-in takes longer than anybody has patience for.
TEST_F(BadInput, InterruptWhilePlottingLeavesEarlierResultsAlone) {
  ASSERT_EQ(raytube("run case.toml -o old --set look.theta_deg=20 --set output.plots=false").code, 0);
  const std::string earlier = text_of(scratch / "old/rcs.csv");
  fs::permissions(scratch.write("gnuplot", "#!/bin/sh\nexec sleep 100\n"), fs::perms::owner_all);
  EXPECT_EQ(raytube("run case.toml -o old", "PATH=.:$PATH timeout --preserve-status -s INT -k 5 1 ").code, 130);
  EXPECT_EQ(text_of(scratch / "old/rcs.csv"), earlier);
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "old"), {}), 4);  // with their list: nothing beside them
}

// gnuplot does not end when it is told to, so that the watch over the interrupt has to end the program.
TEST_F(BadInput, ATerminationRequestEndsAsCtrlCDoes) {
  fs::permissions(scratch.write("gnuplot", "#!/bin/sh\ntrap '' TERM\nsleep 5\n"), fs::perms::owner_all);
  const Outcome outcome = raytube("run case.toml", "PATH=.:$PATH timeout --preserve-status -s TERM -k 5 1 ");
  EXPECT_EQ(outcome.code, 130);
  EXPECT_THAT(outcome.complaint, HasSubstr("interrupted"));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST_F(BadInput, CommandLine) {
  expect_refused("fly", "unknown command \"fly\"");
  expect_refused("--verbose", "unknown");
  expect_refused("run", "raytube run --help");
  expect_refused("run case.toml more.toml", "more.toml");
  expect_refused("run case.toml --bogus", "--bogus");
  expect_refused("run case.toml --threads 0", "--threads");
  expect_refused("run case.toml --threads two", "--threads");
  expect_refused("run case.toml --set", "--set");
  expect_refused("run case.toml --set tubes", "no KEY=VALUE");
  expect_refused("trace case.toml --u 0 --v 0", "--look");
  expect_refused("trace case.toml --look -1 --u 0 --v 0", "--look");
  expect_refused("trace case.toml --look 1 --u 0 --v 0", "1 direction pair");
  expect_refused("trace case.toml --look 0 --u nan --v 0", "finite");
  expect_refused("trace case.toml --look 0 --u 1e9 --v 0", "--u");
}

}  // namespace
}  // namespace raytube
