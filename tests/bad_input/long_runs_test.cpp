// Runs that are stopped, resumed, kept out of a folder, or have no room on disk or in memory.
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>

#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Minutes of work in looks of milliseconds.
const std::string minutes =
    "case.toml --set target.unit=m --set tubes.mode=uniform --set edges.method=none --set output.plots=false --set "
    "'look.phi_deg={start=0,stop=90,step=0.01}' ";
// The first of these looks.
const std::string journal = "out/.raytube.journal";

class LongRuns : public BadInput {
 protected:
  // Ctrl-C as soon as the file named has something in it.
  Outcome interrupted_once_there_is(const std::string& file, const std::string& before = "exec ", const std::string& more = "",
                                    const std::string& words = "run ") const {
    const std::string command = "cd '" + scratch.folder().string() + "'; (" + before + RAYTUBE_PROGRAM " " + words + minutes +
                                more + ">stdout.txt 2>stderr.txt) & run=$!; while ! [ -s " + file +
                                " ]; do sleep 0.1; done; kill -INT $run; wait $run";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(scratch / "stderr.txt")};
  }
};

TEST_F(LongRuns, WhatIsKeptIsSaidAndNotLost) {
  const Outcome stopped = interrupted_once_there_is(journal);
  EXPECT_EQ(stopped.code, 130);
  EXPECT_THAT(stopped.complaint, AllOf(HasSubstr("looks are kept in"), HasSubstr("continue with --resume")));
  ASSERT_TRUE(fs::exists(scratch / journal));
  EXPECT_FALSE(fs::exists(scratch / "out/.raytube.lock"));
  const std::string kept = text_of(scratch / journal);

  const Outcome forgotten = raytube("run " + minutes);
  EXPECT_EQ(forgotten.code, 2);
  EXPECT_THAT(forgotten.complaint,
              AllOf(HasSubstr(".raytube.journal holds"), HasSubstr("--resume"), HasSubstr("delete the file")));

  const Outcome changed = raytube("run " + minutes + "--resume --set tubes.per_wavelength=11");
  EXPECT_EQ(changed.code, 2);
  EXPECT_THAT(changed.complaint,
              AllOf(HasSubstr("begun with tubes.per_wavelength = 10.0 (now 11.0);"), HasSubstr("delete the file")));

  const Outcome longer = raytube("run " + minutes + "--resume --set 'look.phi_deg={start=0,stop=90,step=0.02}'");
  EXPECT_EQ(longer.code, 2);
  EXPECT_THAT(longer.complaint, HasSubstr("look.phi_deg = ...0.01,0.02,"));
  EXPECT_THAT(longer.complaint, HasSubstr(" (now ...0.02,0.04,"));
  const Outcome painted = raytube("run " + minutes + "--resume --set target.material=absorber");
  EXPECT_THAT(painted.complaint, HasSubstr("begun with target.material = \"pec\" (now \"absorber\")"));
  const Outcome nearer = raytube("run " + minutes + "--resume --set radar.range_m=1000");
  EXPECT_THAT(nearer.complaint, HasSubstr("begun with radar.range_m = not given (now 1000.0)"));

  scratch.write("mesh.off", plate + "# the same, but not the same file\n");
  const Outcome another_mesh = raytube("run " + minutes + "--resume");
  EXPECT_EQ(another_mesh.code, 2);
  EXPECT_THAT(another_mesh.complaint, HasSubstr("begun with another mesh in target.mesh"));
  EXPECT_EQ(text_of(scratch / journal), kept);
}

TEST_F(LongRuns, LooksOfAnotherTableOfAMediumAreNotMixed) {
  const std::string glass =
      "--set target.material=glass --set materials.glass.kind=dielectric --set materials.glass.table_csv=glass.csv ";
  const std::string table = "freq_ghz,eps_real,eps_loss\n1,4,0\n20,4,0\n";
  scratch.write("glass.csv", table);
  EXPECT_EQ(interrupted_once_there_is(journal, "exec ", glass).code, 130);
  const std::string kept = text_of(scratch / journal);
  ASSERT_FALSE(kept.empty());
  scratch.write("glass.csv", table + "30,5,0\n");
  const Outcome changed = raytube("run " + minutes + glass + "--resume");
  EXPECT_EQ(changed.code, 2);
  EXPECT_THAT(changed.complaint, AllOf(HasSubstr("begun with another table glass.csv"), HasSubstr("delete the file")));
  EXPECT_EQ(text_of(scratch / journal), kept);
}

TEST_F(LongRuns, AProfileOfACaseGoesOnWhereItWasStopped) {
  const std::string band = "--set 'frequency.ghz=[9.95,10]' --set 'look.phi_deg={start=0,stop=4,step=0.01}' ";
  EXPECT_EQ(interrupted_once_there_is(journal, "exec ", band + "--threads 1 ", "profile ").code, 130);
  ASSERT_TRUE(fs::exists(scratch / journal));
  EXPECT_THAT(raytube("profile " + minutes + band).complaint, HasSubstr("continue with --resume"));
  ASSERT_EQ(raytube("profile " + minutes + band + "--resume --quiet").code, 0);
  EXPECT_FALSE(fs::exists(scratch / journal));
  EXPECT_THAT(text_of(scratch / "out/run.json"), Not(HasSubstr("\"looks_resumed\": 0")));
  ASSERT_EQ(raytube("profile " + minutes + band + "--quiet -o whole").code, 0);
  for (const char* name : {"rcs.csv", "profile.csv"})
    EXPECT_TRUE(text_of(scratch / "out" / name) == text_of(scratch / "whole" / name)) << name;
}

TEST_F(LongRuns, NothingToResumeIsAFreshStart) {
  const Outcome outcome = raytube("run case.toml --resume --set output.plots=false");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint, HasSubstr("nothing to resume in"));
  EXPECT_TRUE(fs::exists(scratch / "out/rcs.csv"));
  EXPECT_FALSE(fs::exists(scratch / journal));
}

TEST_F(LongRuns, AFinishedRunIsNotRepeated) {
  scratch.write("looks.csv", "theta_deg,phi_deg\n10,0\n20,0\n");
  const std::string run = "run case.toml --set output.plots=false --set 'look={looks_csv=\"looks.csv\"}' ";
  ASSERT_EQ(raytube(run).code, 0);
  const std::string before = text_of(scratch / "out/run.json");
  EXPECT_EQ(raytube(run + "--resume").code, 0);
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("finished"));
  EXPECT_EQ(text_of(scratch / "out/run.json"), before);

  const Outcome other = raytube(run + "--resume --set tubes.max_bounces=3");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.complaint, AllOf(HasSubstr("tubes.max_bounces = 8 (now 3)"), HasSubstr("-o DIR")));
  scratch.write("looks.csv", "theta_deg,phi_deg\n10,0\n30,0\n");
  EXPECT_THAT(raytube(run + "--resume").complaint, HasSubstr("another list in look.looks_csv"));
  scratch.write("looks.csv", "theta_deg,phi_deg\n10,0\n20,0\n");
  scratch.write("mesh.off", plate + "# the same, but not the same file\n");
  EXPECT_THAT(raytube(run + "--resume").complaint, HasSubstr("another mesh in target.mesh"));
  scratch.write("mesh.off", plate);
  EXPECT_EQ(text_of(scratch / "out/run.json"), before);

  EXPECT_EQ(raytube(run + "--resume --parts").code, 0);  // a table is missing
  EXPECT_TRUE(fs::exists(scratch / "out/parts.csv"));
}

TEST_F(LongRuns, AJournalThatIsNone) {
  fs::create_directory(scratch / "out");
  scratch.write(journal, "something else, longer than a line");
  for (const char* words : {"run case.toml", "run case.toml --resume"}) {
    const Outcome outcome = raytube(words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.complaint, HasSubstr("is no journal of this program; delete it"));
  }
  scratch.write(journal, "raytube jour");  // killed while it was begun
  EXPECT_EQ(raytube("run case.toml --set output.plots=false").code, 0);
}

TEST_F(LongRuns, TheSecondIntoAFolderIsRefused) {
  fs::create_directory(scratch / "out");
  const int owner = open((scratch / "out/.raytube.lock").c_str(), O_RDWR | O_CREAT, 0666);
  ASSERT_EQ(flock(owner, LOCK_EX), 0);
  for (const char* words : {"run case.toml", "run case.toml --resume", "converge case.toml --densities 1,2,3"}) {
    const Outcome outcome = raytube(words);
    EXPECT_EQ(outcome.code, 2) << words;
    EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("another raytube"), HasSubstr("choose another one with -o DIR"))) << words;
  }
  close(owner);
  EXPECT_EQ(raytube("run case.toml --set output.plots=false").code, 0);
}

// A file size limit stands for a full disk; the earlier results are larger than it, and stay.
TEST_F(LongRuns, AFullDiskLeavesEarlierResultsAlone) {
  ASSERT_EQ(raytube("run case.toml --set look.theta_deg=20 --set output.plots=false").code, 0);
  const std::string earlier = text_of(scratch / "out/rcs.csv");
  const Outcome outcome = raytube("run case.toml --set output.plots=false", "ulimit -f 1; ");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("rcs.csv: cannot be written completely"),
                                       HasSubstr("is the disk full? Make room, or write elsewhere with -o")));
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), earlier);
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch / "out"), {}), 4);  // with their list
}

TEST_F(LongRuns, AJournalThatFindsNoRoomCostsOneWarning) {
  const Outcome outcome = interrupted_once_there_is("stderr.txt", "ulimit -f 1; exec ", "--quiet ");
  EXPECT_EQ(outcome.code, 130);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("can no longer be resumed"), HasSubstr(".raytube.journal: File too large")));
  EXPECT_EQ(std::count(outcome.complaint.begin(), outcome.complaint.end(), '\n'), 2) << outcome.complaint;
}

TEST_F(LongRuns, AFolderRemovedMeanwhileEndsTheRun) {
  const std::string command = "cd '" + scratch.folder().string() + "'; (exec " + RAYTUBE_PROGRAM " run " + minutes +
                              ">stdout.txt 2>stderr.txt) & run=$!; while ! [ -s " + journal +
                              " ]; do sleep 0.1; done; rm -r out; wait $run";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_THAT(text_of(scratch / "stderr.txt"), HasSubstr("out was removed"));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

TEST_F(LongRuns, MoreMemoryThanThereIsIsSaidBeforehand) {
  if (!memory_can_be_limited) GTEST_SKIP() << "under a sanitizer";
  const std::string rows =
      "run case.toml --parts --set 'frequency.ghz={start=1,stop=10,count=5000}' --set "
      "'look.phi_deg={start=0,stop=99.9,step=0.1}'";
  const Outcome outcome = raytube(rows, "ulimit -v 1000000; ");
  EXPECT_EQ(outcome.code, 2) << outcome.complaint;
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("case.toml: the run would take about"), HasSubstr("of memory, and there are"),
                                       HasSubstr("rows (looks times frequencies) would fit")));
  const Outcome wide =
      raytube("run case.toml --threads 1 --set 'frequency.ghz={start=1,stop=10,count=1000000}'", "ulimit -v 600000; ");
  EXPECT_EQ(wide.code, 2) << wide.complaint;
  EXPECT_THAT(wide.complaint, HasSubstr("of its 1000000 frequencies would fit"));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

// `check` says what it can, and ends as a run would.
TEST_F(LongRuns, MoreMemoryThanThereIsIsToldByCheckToo) {
  if (!memory_can_be_limited) GTEST_SKIP() << "under a sanitizer";
  const std::string rows =
      "check case.toml --set 'frequency.ghz={start=1,stop=10,count=5000}' --set 'look.phi_deg={start=0,stop=159.9,step=0.1}'";
  const Outcome outcome = raytube(rows, "ulimit -v 500000; ");
  EXPECT_EQ(outcome.code, 2) << outcome.complaint;
  EXPECT_THAT(outcome.complaint, HasSubstr("case.toml: the run would take about"));
  EXPECT_THAT(text_of(scratch / "stdout.txt"), HasSubstr("\nmemory\n  at most about"));
}

// Whatever the limit, a run ends with its results, or with a sentence and the earlier ones as they were.
TEST_F(LongRuns, TooLittleMemoryForTheLibrariesIsSaid) {
  if (!memory_can_be_limited) GTEST_SKIP() << "under a sanitizer";
  ASSERT_EQ(raytube("run case.toml --set output.plots=false").code, 0);
  const std::string earlier = text_of(scratch / "out/run.json");
  bool fell_short = false;
  for (int megabytes = 100; megabytes <= 300; megabytes += 20) {
    const std::string limit = "ulimit -v " + std::to_string(1000 * megabytes) + "; ";
    const Outcome outcome = raytube("run case.toml --set output.plots=false", limit);
    if (outcome.code == 0) break;
    if (outcome.code == 127) continue;  // the loader did not come as far as the program
    EXPECT_THAT(outcome.code, AnyOf(2, 3)) << limit;
    EXPECT_THAT(outcome.complaint, AnyOf(HasSubstr("out of memory; earlier results are as they were. End other programs or"),
                                         HasSubstr("the run would take about")))
        << limit;
    EXPECT_EQ(text_of(scratch / "out/run.json"), earlier);
    fell_short = fell_short || outcome.code == 3;
  }
  EXPECT_TRUE(fell_short);
}

}  // namespace
}  // namespace raytube
