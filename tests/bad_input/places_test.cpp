// Where results go: beside files of somebody's own, over earlier results, into folders that vanish, onto disks that are full.
#include <nlohmann/json.hpp>

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

// Versions before the list left none; run.json tells their results.
TEST_F(Places, ARunReplacesAllOfAnEarlierVersion) {
  ASSERT_EQ(raytube("run case.toml --parts --set 'output.image_look=[0]'").code, 0);
  fs::remove(scratch / "out/.raytube.results");
  const Outcome outcome = raytube("run case.toml" + no_plots);
  EXPECT_EQ(outcome.code, 0) << outcome.complaint;
  EXPECT_EQ(files_in("out"), 4u);

  fs::remove(scratch / "out/.raytube.results");
  scratch.write("out/rcs.png", "mine");  // that run made no plots
  EXPECT_EQ(raytube("run case.toml").code, 2);
  EXPECT_EQ(text_of(scratch / "out/rcs.png"), "mine");
  fs::remove(scratch / "out/rcs.png");
  scratch.write("out/rcs.csv", "mine");  // not what run.json was written with
  EXPECT_EQ(raytube("run case.toml").code, 2);
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), "mine");
}

// A run always writes channels.csv, but what lies there by now is something else.
TEST_F(Places, WhatLiesUnderANameOfAnEarlierVersionStays) {
  ASSERT_EQ(raytube("run case.toml" + no_plots).code, 0);
  fs::remove(scratch / "out/.raytube.results");
  fs::remove(scratch / "out/channels.csv");
  fs::create_symlink(scratch.write("mine.csv", "mine"), scratch / "out/channels.csv");
  EXPECT_EQ(raytube("run case.toml" + no_plots).code, 2);
  EXPECT_TRUE(fs::is_symlink(scratch / "out/channels.csv"));
  fs::remove(scratch / "out/channels.csv");
  fs::create_directory(scratch / "out/channels.csv");
  const Outcome outcome = raytube("run case.toml" + no_plots);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, HasSubstr("out/channels.csv: is a folder where a result is to go"));
  EXPECT_EQ(files_in("out"), 3u);  // rcs.csv and run.json are still there
}

TEST_F(Places, ARunJsonOfOddTypesIsNobodysResult) {
  ASSERT_EQ(raytube("run case.toml" + no_plots).code, 0);
  fs::remove(scratch / "out/.raytube.results");
  auto json = nlohmann::json::parse(text_of(scratch / "out/run.json"));
  json["case"]["output"] = 3;
  scratch.write("out/run.json", json.dump());
  const Outcome outcome = raytube("run case.toml" + no_plots);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, HasSubstr("is where a result is to go, and is not what raytube has written there"));
}

TEST_F(Places, TheListNeedsRoomToo) {
  fs::create_directories(scratch / "out/.raytube.results");
  stand_in_for_gnuplot("touch drawn\n");
  const Outcome outcome = raytube("run case.toml", with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("out/.raytube.results: is where the list of results is to go"),
                                       HasSubstr("; move it away, or choose another folder with -o DIR")));
  EXPECT_FALSE(fs::exists(scratch / "drawn"));  // before the work
}

TEST_F(Places, OtherCommandsReplaceThoseOfAnEarlierVersion) {
  scratch.write("a.csv", "phi_deg,sigma_vv_dbsm\n0,1\n1,2\n");
  for (const std::string words : {"compare a.csv a.csv -o out", "converge case.toml --densities 1,2,4"}) {
    ASSERT_EQ(raytube(words).code, 0);
    fs::remove(scratch / "out/.raytube.results");
    EXPECT_EQ(raytube(words).code, 0) << words << text_of(scratch / "stderr.txt");
  }
}

TEST_F(Places, WhatIsNotInTheWayStays) {
  for (const char* name : {"parts.csv", "image.csv", "image_7.png", "rcs.png", "random.csv", "compare.csv"})
    scratch.write(name, "mine");
  const Outcome outcome = raytube("run case.toml -o ." + no_plots);
  EXPECT_EQ(outcome.code, 0) << outcome.complaint;
  EXPECT_EQ(raytube("run case.toml -o ." + no_plots).code, 0);
  for (const char* name : {"parts.csv", "image.csv", "image_7.png", "rcs.png", "random.csv", "compare.csv"})
    EXPECT_EQ(text_of(scratch / name), "mine") << name;
}

TEST_F(Places, AnEditedResultIsNoResult) {
  ASSERT_EQ(raytube("run case.toml" + no_plots).code, 0);
  const std::string edited = text_of(scratch / "out/rcs.csv") + "# seen and approved\n";
  scratch.write("out/rcs.csv", edited);
  const Outcome outcome = raytube("run case.toml" + no_plots);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("out/rcs.csv: is where a result is to go"), HasSubstr("; move it away")));
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), edited);
}

TEST_F(Places, AFullDeviceForWhatIsPrintedIsSaid) {
  for (const char* words : {"--help", "--version", "check case.toml", "trace case.toml --look 0 --u 0 --v 0"}) {
    const Outcome outcome = raytube_printing_to("/dev/full", words);
    EXPECT_EQ(outcome.code, 1) << words;
    EXPECT_EQ(outcome.complaint, "raytube: standard output: cannot be written completely; is the disk full? Send it elsewhere\n");
  }
  EXPECT_EQ(raytube_printing_to("/dev/full", "run case.toml" + no_plots).code, 1);
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

// While the first picture is drawn, and never again.
TEST_F(Places, AFolderRemovedWhileResultsAreWrittenIsMadeAgain) {
  stand_in_for_gnuplot("[ -e once ] && exit 1; touch once; rm -r out\n");
  const Outcome outcome = raytube("run case.toml", with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.complaint, HasSubstr("out was removed; it is made again"));
  EXPECT_TRUE(fs::exists(scratch / "out/rcs.csv"));
  EXPECT_TRUE(fs::exists(scratch / "out/run.json"));
  EXPECT_EQ(raytube("run case.toml" + no_plots).code, 0);
}

// What gnuplot is told to write to: set output '...'.
const std::string half_a_picture = R"sh(printf '\211PNG half' >"$(sed -n "s/^set output '\(.*\)'$/\1/p" "$2" | head -n 1)")sh"
                                   "\n";

TEST_F(Places, HalfAPictureIsNone) {
  stand_in_for_gnuplot(half_a_picture);
  const Outcome outcome = raytube("run case.toml --quiet --set target.unit=m", with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.complaint, "raytube: no plot: gnuplot left half a picture; rcs.csv holds the same curves\n");
  EXPECT_FALSE(fs::exists(scratch / "out/rcs.png"));
}

// The tables find room below the limit, a picture does not.
TEST_F(Places, ADiskThatIsFullAtThePictureLeavesEarlierResultsAlone) {
  ASSERT_EQ(raytube("run case.toml --set look.theta_deg=20").code, 0);
  const std::string table = text_of(scratch / "out/rcs.csv"), picture = text_of(scratch / "out/rcs.png");
  stand_in_for_gnuplot(half_a_picture);
  const Outcome outcome = raytube("run case.toml", "ulimit -f 64; " + with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.complaint, HasSubstr("rcs.png: cannot be written completely; is the disk full?"));
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), table);
  EXPECT_EQ(text_of(scratch / "out/rcs.png"), picture);
}

// Half of it is more than the whole of most pictures.
TEST_F(Places, ADiskThatIsFullInABigPictureIsFull) {
  ASSERT_EQ(raytube("run case.toml --set look.theta_deg=20").code, 0);
  const std::string table = text_of(scratch / "out/rcs.csv"), picture = text_of(scratch / "out/rcs.png");
  stand_in_for_gnuplot(R"sh(head -c 9000000 /dev/zero >"$(sed -n "s/^set output '\(.*\)'$/\1/p" "$2" | head -n 1)")sh"
                       "\n");
  const Outcome outcome = raytube("run case.toml", "ulimit -f 2048; " + with_gnuplot_from_here);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.complaint, HasSubstr("rcs.png: cannot be written completely; is the disk full?"));
  EXPECT_EQ(text_of(scratch / "out/rcs.csv"), table);
  EXPECT_EQ(text_of(scratch / "out/rcs.png"), picture);
  EXPECT_EQ(files_in("out"), 6u);  // with channels.csv, run.json, rcs.svg and the list: no trial is left
}

}  // namespace
}  // namespace raytube
