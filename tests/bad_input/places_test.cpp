// Where results go: beside files of somebody's own, over earlier results, into folders that vanish, onto disks that are full.
#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

const std::string no_plots = " --set output.plots=false";
const std::string with_gnuplot_from_here = "PATH=.:$PATH ";

class Places : public BadInput {
 protected:
  std::size_t files_in(const std::string& folder) const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(scratch / folder), {}));
  }

  void stand_in_for_gnuplot(const std::string& script) const {
    fs::permissions(scratch.write("gnuplot", "#!/bin/sh\n" + script), fs::perms::owner_all);
  }

  // With stdout as the shell has it.
  Outcome raytube_printing_to(const std::string& output, const std::string& words) const {
    const std::string command =
        "cd '" + scratch.folder().string() + "' && " RAYTUBE_PROGRAM " " + words + " >" + output + " 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(scratch / "stderr.txt")};
  }
};

TEST_F(Places, ARunReplacesAllOfAnEarlierOne) {
  ASSERT_EQ(raytube("run case.toml --parts --set output.image_look=0").code, 0);
  ASSERT_TRUE(fs::exists(scratch / "out/rcs.png"));
  ASSERT_TRUE(fs::exists(scratch / "out/image.png"));
  const Outcome outcome = raytube("run case.toml" + no_plots);
  EXPECT_EQ(outcome.code, 0) << outcome.complaint;
  EXPECT_EQ(files_in("out"), 4u);  // rcs.csv, channels.csv, run.json and their list; no parts, no pictures
}

TEST_F(Places, TheListIsThatOfSha256sum) {
  ASSERT_EQ(raytube("run case.toml").code, 0);
  EXPECT_EQ(
      std::system(("cd '" + (scratch / "out").string() + "' && sha256sum --check --strict --quiet .raytube.results").c_str()), 0);
}

TEST_F(Places, TheListNeedsRoomToo) {
  fs::create_directories(scratch / "out/.raytube.results");
  stand_in_for_gnuplot("touch drawn\n");
  const Outcome outcome = raytube("run case.toml", with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("out/.raytube.results: the list of results belongs here"),
                                       HasSubstr("; move it away, or choose another folder with -o DIR")));
  EXPECT_FALSE(fs::exists(scratch / "drawn"));  // before the work
}

TEST_F(Places, WhatIsNotInTheWayStays) {
  for (const char* name : {"parts.csv", "image.csv", "image_7.png", "rcs.png", "compare.csv"}) scratch.write(name, "mine");
  const Outcome outcome = raytube("run case.toml -o ." + no_plots);
  EXPECT_EQ(outcome.code, 0) << outcome.complaint;
  EXPECT_EQ(raytube("run case.toml -o ." + no_plots).code, 0);
  for (const char* name : {"parts.csv", "image.csv", "image_7.png", "rcs.png", "compare.csv"})
    EXPECT_EQ(text_of(scratch / name), "mine") << name;
}

TEST_F(Places, AnEditedResultIsNoResult) {
  ASSERT_EQ(raytube("run case.toml" + no_plots).code, 0);
  const std::string edited = text_of(scratch / "out/rcs.csv") + "# seen and approved\n";
  scratch.write("out/rcs.csv", edited);
  const Outcome outcome = raytube("run case.toml" + no_plots);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("out/rcs.csv: is in the place of a result"), HasSubstr("; move it away")));
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), edited);
}

TEST_F(Places, AFullDeviceForWhatIsPrintedIsSaid) {
  for (const char* words : {"--help", "--version", "check case.toml", "trace case.toml --look 0 --u 0 --v 0"}) {
    const Outcome outcome = raytube_printing_to("/dev/full", words);
    EXPECT_EQ(outcome.code, 3) << words;
    EXPECT_EQ(outcome.complaint, "raytube: standard output: cannot be written completely; is the disk full? Send it elsewhere\n");
  }
  EXPECT_EQ(raytube_printing_to("/dev/full", "run case.toml" + no_plots).code, 3);
  const std::string whole = text_of(scratch / "out/rcs.csv");
  EXPECT_EQ(raytube("run case.toml" + no_plots).code, 0);
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), whole);
}

// The first file that is opened then would be stdout.
TEST_F(Places, AClosedStdoutDoesNoHarm) {
  EXPECT_EQ(raytube_printing_to("&- 0<&-", "run case.toml" + no_plots).code, 0);
  const std::string without = text_of(scratch / "out/rcs.csv");
  EXPECT_EQ(raytube("run case.toml" + no_plots).code, 0);
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), without);
}

// While the first picture is drawn.
TEST_F(Places, AFolderRemovedWhileResultsAreWrittenEndsTheRun) {
  stand_in_for_gnuplot("rm -rf out\n");
  const Outcome outcome = raytube("run case.toml --quiet --set target.unit=m", with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.complaint, HasSubstr("out was removed"));
  EXPECT_FALSE(fs::exists(scratch / "out"));
}

// What gnuplot is told to write to: set output '...'.
const std::string half_a_picture = R"sh(printf '\211PNG half' >"$(sed -n "s/^set output '\(.*\)'$/\1/p" "$2" | head -n 1)")sh"
                                   "\n";

// As gnuplot leaves one on a full disk, without a word.
TEST_F(Places, HalfAPictureIsNone) {
  stand_in_for_gnuplot(half_a_picture);
  const Outcome outcome = raytube("run case.toml --quiet --set target.unit=m", with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("no picture"), HasSubstr("is the disk full?")));
  EXPECT_TRUE(fs::exists(scratch / "out/rcs.csv"));
  EXPECT_FALSE(fs::exists(scratch / "out/rcs.png"));
}

}  // namespace
}  // namespace raytube
