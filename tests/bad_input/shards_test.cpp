// Shards of a run: what one run would have written, or one sentence and nothing.
#include <fmt/format.h>

#include "program.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string sweep = "case.toml --quiet --set output.plots=false --set look.theta_deg=[10,20,30,40,50] ";

class Shards : public BadInput {
 protected:
  void SetUp() override {
    BadInput::SetUp();
    for (const char* shard : {"1/3", "2/3", "3/3"}) ASSERT_EQ(shard_of(sweep, shard).code, 0);
  }

  Outcome shard_of(const std::string& words, const std::string& shard) const {
    return raytube("run " + words + "-o shards --shard " + shard);
  }

  fs::path file(int index, int count = 3) const { return scratch / fmt::format("shards/shard_{}_of_{}.looks", index, count); }

  /// The merge is refused, and leaves the folder as it was.
  void expect_no_merge(const std::string& sentence, const std::string& words = "shards") const {
    const Outcome outcome = raytube("merge " + words);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.complaint, HasSubstr(sentence));
    EXPECT_EQ(std::count(outcome.complaint.begin(), outcome.complaint.end(), '\n'), 1) << outcome.complaint;
    EXPECT_FALSE(fs::exists(scratch / "shards/rcs.csv"));
    EXPECT_FALSE(fs::exists(scratch / "shards/run.json"));
  }
};

TEST_F(Shards, GiveWhatOneRunGives) {
  ASSERT_EQ(raytube("run " + sweep + "-o one --parts").code, 0);
  ASSERT_EQ(raytube("merge shards --quiet --parts").code, 0);
  ASSERT_EQ(raytube("merge shards --quiet -o merged.nc").code, 0);
  ASSERT_EQ(raytube("run " + sweep + "-o one.nc").code, 0);
  for (const char* name : {"rcs.csv", "channels.csv", "parts.csv"})
    EXPECT_EQ(text_of(scratch / "shards" / name), text_of(scratch / "one" / name)) << name;
  EXPECT_EQ(text_of(scratch / "merged.nc"), text_of(scratch / "one.nc"));
}

TEST_F(Shards, MoreThanThereAreLooksIsNoHarm) {
  for (int index = 1; index <= 7; ++index) ASSERT_EQ(raytube(fmt::format("run {} -o many --shard {}/7", sweep, index)).code, 0);
  ASSERT_EQ(raytube("merge many --quiet").code, 0);
  ASSERT_EQ(raytube("merge shards --quiet").code, 0);
  EXPECT_EQ(text_of(scratch / "many/rcs.csv"), text_of(scratch / "shards/rcs.csv"));
}

TEST_F(Shards, OneIsMissing) {
  fs::remove(file(2));
  expect_no_merge("1 of 3 shards is missing: 2/3; run each with raytube run");
  ASSERT_EQ(shard_of(sweep, "2/3").code, 0);
  EXPECT_EQ(raytube("merge shards --quiet").code, 0);
}

TEST_F(Shards, OneIsThereTwice) {
  fs::copy(file(2), scratch / "shards/copy.looks");
  expect_no_merge("are both shard 2/3; delete one of them");
}

TEST_F(Shards, OneIsOfAnotherNumber) {
  EXPECT_EQ(shard_of(sweep, "1/4").code, 2);
  ASSERT_EQ(raytube("run " + sweep + "-o elsewhere --shard 1/4").code, 0);
  fs::copy(scratch / "elsewhere/shard_1_of_4.looks", file(1, 4));
  expect_no_merge("belong to different runs");
}

TEST_F(Shards, OneIsCutShort) {
  const std::string whole = text_of(file(2));
  fs::resize_file(file(2), 20);
  expect_no_merge("is truncated, or not a shard");
  scratch.write("shards/shard_2_of_3.looks", whole.substr(0, whole.size() - 10));
  expect_no_merge("holds 1 of its 2 looks: it was interrupted, is still running, or is truncated; run shard 2/3 again");
  ASSERT_EQ(shard_of(sweep, "2/3").code, 0);  // goes on from there
  EXPECT_EQ(text_of(file(2)), whole);
  EXPECT_EQ(raytube("merge shards --quiet").code, 0);
}

TEST_F(Shards, OneIsOfAnotherMesh) {
  fs::remove(file(2));
  const std::string mesh = text_of(scratch / "mesh.off");
  scratch.write("mesh.off", mesh + "# the same, but not the same file\n");
  ASSERT_EQ(shard_of(sweep, "2/3").code, 0);
  scratch.write("mesh.off", mesh);
  expect_no_merge("was computed with another mesh in target.mesh; run shard 2/3 again");
}

TEST_F(Shards, OneIsOfAnotherCase) {
  fs::remove(file(2));
  ASSERT_EQ(shard_of(sweep + "--set tubes.per_wavelength=7 ", "2/3").code, 0);
  expect_no_merge("was computed with tubes.per_wavelength = 7.0 (now");
}

TEST_F(Shards, AnotherSweepIsNotGoneOnWith) {
  const Outcome outcome = shard_of(sweep + "--set tubes.per_wavelength=7 ", "2/3");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, AllOf(HasSubstr("was begun with tubes.per_wavelength"), HasSubstr("delete the file")));
}

TEST_F(Shards, ACaseThatHasMovedIsNamed) {
  fs::rename(scratch / "case.toml", scratch / "moved.toml");
  expect_no_merge("case.toml: no such file");
  EXPECT_EQ(raytube("merge shards moved.toml --quiet").code, 0);
  EXPECT_TRUE(fs::exists(scratch / "shards/rcs.csv"));
}

TEST_F(Shards, ThereAreNone) {
  fs::create_directory(scratch / "empty");
  expect_no_merge("holds no shards", "empty");
  expect_no_merge("cannot be read", "nowhere");
}

TEST_F(Shards, WrongOptions) {
  for (const char* shard : {"0/3", "4/3", "1/0", "3", "a/b", "1/2/3", "-1/3"})
    expect_refused("run case.toml --shard " + std::string(shard), "write I/N, I from 1 to N, such as 3/7");
  expect_refused("run case.toml --shard slurm", "SLURM_ARRAY_TASK_ID is not set");
  expect_refused("run case.toml --shard 1/2 --parts", "give it to raytube merge");
  expect_refused("run case.toml --shard 1/2 -o x.nc", "a shard is only part of a result");
}

TEST_F(Shards, TasksOfAJobArray) {
  const std::string array = "SLURM_ARRAY_TASK_MIN=4 SLURM_ARRAY_TASK_MAX=6 SLURM_ARRAY_TASK_COUNT=3 ";
  for (const char* task : {"4", "5", "6"})
    ASSERT_EQ(raytube("run " + sweep + "-o array --shard slurm", "export " + array + "SLURM_ARRAY_TASK_ID=" + task + "; ").code,
              0);
  ASSERT_EQ(raytube("merge array --quiet").code, 0);
  const Outcome gaps =
      raytube("run " + sweep + "--shard slurm", "export " + array + "SLURM_ARRAY_TASK_MAX=8 SLURM_ARRAY_TASK_ID=8; ");
  EXPECT_EQ(gaps.code, 2);
  EXPECT_THAT(gaps.complaint, HasSubstr("3 tasks from 4 to 8, with gaps"));
}

// A file size limit stands for a full disk.
TEST_F(Shards, AFullDiskIsAnError) {
  const Outcome outcome = raytube("run " + sweep + "-o full --shard 1/2", "ulimit -f 1; ");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.complaint, HasSubstr("File too large"));
}

}  // namespace
}  // namespace raytube
