// Files appear whole or not at all.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"
#include "output/files/earlier_results.h"
#include "output/files/files.h"
#include "output/files/manifest.h"
#include "output/files/sha256.h"
#include "scratch.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;

int entries(const fs::path& folder) { return static_cast<int>(std::distance(fs::directory_iterator(folder), {})); }

void write(const fs::path& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

TEST(NewResults, EarlierOnesStayUntilTheNewTakeTheirPlace) {
  const Scratch scratch;
  scratch.write("a.csv", "old");
  {
    const NewResults abandoned(scratch.folder());
    write(abandoned.folder() / "a.csv", "half");
    EXPECT_EQ(text_of(scratch / "a.csv"), "old");
  }
  EXPECT_EQ(text_of(scratch / "a.csv"), "old");
  EXPECT_EQ(entries(scratch.folder()), 1);
  {
    NewResults results(scratch.folder());
    write(results.folder() / "a.csv", "new");
    write(results.folder() / "not-placed.csv", "");
    results.place({"not-written.csv", "a.csv"});
  }
  EXPECT_EQ(text_of(scratch / "a.csv"), "new");
  EXPECT_EQ(entries(scratch.folder()), 1);
}

TEST(NewResults, AnOccupiedPlaceThrows) {
  const Scratch scratch;
  fs::create_directories(scratch / "a.csv/folder");
  NewResults results(scratch.folder());
  write(results.folder() / "a.csv", "new");
  EXPECT_THROW(results.place({"a.csv"}), std::runtime_error);
}

// A place that cannot be had shows when some have been taken.
TEST(NewResults, AreTakenBack) {
  const Scratch scratch;
  scratch.write("a.csv", "old");
  scratch.write("b.csv", "old, too");
  fs::create_directories(scratch / "d.csv/folder");
  {
    NewResults results(scratch.folder());
    for (const char* name : {"a.csv", "b.csv", "c.csv", "d.csv"}) write(results.folder() / name, "new");
    EXPECT_THROW(results.place({"b.csv", "c.csv", "a.csv", "d.csv"}), std::runtime_error);
    EXPECT_EQ(text_of(scratch / "a.csv"), "new");
    EXPECT_TRUE(results.has_placed("c.csv"));
    EXPECT_FALSE(results.has_placed("d.csv"));
    results.take_back();
  }
  EXPECT_EQ(text_of(scratch / "a.csv"), "old");
  EXPECT_EQ(text_of(scratch / "b.csv"), "old, too");
  EXPECT_FALSE(fs::exists(scratch / "c.csv"));
  EXPECT_TRUE(fs::exists(scratch / "d.csv/folder"));
  EXPECT_EQ(entries(scratch.folder()), 3);
}

// Process numbers come again, in containers even at once.
TEST(NewResults, NeverTakeWhatAnotherProcessLeft) {
  const Scratch scratch;
  fs::path left;
  {
    const NewResults results(scratch.folder());
    left = results.folder();
  }
  fs::create_directory(left);
  write(left / "rcs.csv", "stale");
  EXPECT_THROW(NewResults(scratch.folder()), std::runtime_error);
  const OutputFolder folder(scratch.folder());
  EXPECT_FALSE(fs::exists(left));
  { const NewResults results(scratch.folder()); }
}

TEST(OutputFile, UnwritablePlaceThrows) {
  const Scratch scratch;
  EXPECT_THROW(OutputFile(scratch / "no-folder/a.csv"), std::runtime_error);
}

TEST(OutputFolder, LeavesNothingEmptyBehind) {
  const Scratch scratch;
  { const OutputFolder folder(scratch / "a/b/"); }
  EXPECT_FALSE(fs::exists(scratch / "a"));
  {
    const OutputFolder folder(scratch / "c/d");
    OutputFile file(folder.path() / "x");
    file.commit();
  }
  EXPECT_TRUE(fs::exists(scratch / "c/d/x"));
  fs::create_directory(scratch / "was-here");
  { const OutputFolder folder(scratch / "was-here"); }
  EXPECT_TRUE(fs::exists(scratch / "was-here"));
}

TEST(OutputFolder, IsMissedWhereItWasRemovedOrReplaced) {
  const Scratch scratch;
  const OutputFolder folder(scratch / "a/b");
  EXPECT_NO_THROW(folder.require_there());
  fs::remove_all(scratch / "a");
  EXPECT_THROW(folder.require_there(), std::runtime_error);
  const OutputFolder another(scratch / "a/b");
  EXPECT_THROW(folder.require_there(), std::runtime_error);
}

// A thread that finds the folder gone while another one ends the program must not report that: it waits for the end, which this
// test has in another process.
TEST(OutputFolder, IsNotMissedOnceItIsAbandoned) {
  const Scratch scratch;
  const pid_t child = fork();
  if (child == 0) {
    OutputFolder folder(scratch / "a");
    folder.abandon();
    std::thread([&folder] {
      try {
        folder.require_there();
      } catch (const std::runtime_error&) {
      }
      _exit(1);
    }).detach();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_FALSE(fs::exists(scratch / "a"));
}

// Killed while results take their places, it is one or the other that lies there.
TEST(EarlierResults, AreKnownWhileTheyAreReplaced) {
  const Scratch scratch;
  scratch.write("mine.csv", "mine");
  {
    NewResults results(scratch.folder());
    write(results.folder() / "a.csv", "old");
    EarlierResults earlier(scratch.folder());
    earlier.expect(results.folder(), {"a.csv"});
    earlier.announce(results.folder());
    results.place({"a.csv"});
  }
  NewResults results(scratch.folder());
  write(results.folder() / "a.csv", "new");
  EarlierResults earlier(scratch.folder());
  EXPECT_TRUE(earlier.hold("a.csv"));
  EXPECT_FALSE(earlier.hold("mine.csv"));
  earlier.expect(results.folder(), {"a.csv"});
  earlier.announce(results.folder());
  EXPECT_TRUE(EarlierResults(scratch.folder()).hold("a.csv"));  // the old one
  results.place({"a.csv"});
  EXPECT_TRUE(EarlierResults(scratch.folder()).hold("a.csv"));  // the new one
  earlier.settle(results.folder());
  EXPECT_TRUE(EarlierResults(scratch.folder()).hold("a.csv"));
  scratch.write("a.csv", "old");
  EXPECT_FALSE(EarlierResults(scratch.folder()).hold("a.csv"));
  EXPECT_NO_THROW(earlier.require_room({"b.csv"}));
  EXPECT_THROW(earlier.require_room({"b.csv", "mine.csv"}), InputError);
}

TEST(EarlierResults, AreWithdrawnWhereTheyFoundNoPlace) {
  const Scratch scratch;
  for (const char* text : {"old", "new"}) {
    NewResults results(scratch.folder());
    write(results.folder() / "a.csv", text);
    EarlierResults earlier(scratch.folder());
    earlier.expect(results.folder(), {"a.csv"});
    earlier.announce(results.folder());
    results.place({"a.csv"});
    if (text == std::string("old"))
      earlier.settle(results.folder());
    else
      results.take_back(), earlier.withdraw(results.folder());
  }
  EXPECT_TRUE(EarlierResults(scratch.folder()).hold("a.csv"));
  EXPECT_EQ(text_of(scratch / ".raytube.results"), sha256_of_file(scratch / "a.csv") + "  a.csv\n");
  EXPECT_EQ(text_of(scratch / "a.csv"), "old");
}

TEST(OutputFolder, UnderAFileIsBadInput) {
  const Scratch scratch;
  scratch.write("file", "");
  EXPECT_THROW(OutputFolder(scratch / "file"), InputError);
  EXPECT_THROW(OutputFolder(scratch / "file/out"), InputError);
}

TEST(Sha256, KnownDigests) {
  const Scratch scratch;
  EXPECT_EQ(sha256_of_file(scratch.write("empty", "")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_of_file(scratch.write("abc", "abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Manifest, HoldsWhatUsersLookFor) {
  const Scratch scratch;
  Manifest manifest;
  manifest.case_file = "/cases/case.toml";
  manifest.looks_csv_sha256 = "def";
  manifest.case_json = "{\"title\": \"t\"}";
  manifest.program_version = "1.2.3";
  manifest.threads = 7;
  manifest.mesh_report = {{"facets_read", 12.0}, {"weld_distance_m", 1.5e-7}};
  manifest.mesh_notes = {{"border edges", 4.0}};
  manifest.statistics.rays = 30;
  manifest.statistics.hits = {20, 10};
  manifest.statistics.solve_s = 0.5;
  manifest.statistics.skipped = {{"wedges", "concave", 2}};
  manifest.time = {0.1, 0.2, 0.9};
  manifest.peak_rss_bytes = 1000;
  manifest.rcs_csv_sha256 = "abc";
  write_manifest(scratch / "run.json", manifest);
  const auto json = nlohmann::json::parse(text_of(scratch / "run.json"));
  EXPECT_EQ(json["case"]["title"], "t");
  EXPECT_EQ(json["case_file"], "/cases/case.toml");
  EXPECT_EQ(json["looks_csv_sha256"], "def");
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["threads"], 7);
  EXPECT_EQ(json["mesh"]["facets_read"], 12);
  EXPECT_EQ(json["mesh"]["weld_distance_m"], 1.5e-7);
  EXPECT_EQ(json["mesh"]["notes"][0]["count"], 4);
  EXPECT_EQ(json["counts"]["rays"], 30);
  EXPECT_EQ(json["counts"]["hits_per_bounce"], (std::vector<int>{20, 10}));
  EXPECT_EQ(json["counts"]["skipped"][0]["why"], "concave");
  EXPECT_EQ(json["time"]["solve_s"], 0.5);
  EXPECT_EQ(json["time"]["total_s"], 0.9);
  EXPECT_EQ(json["peak_rss_bytes"], 1000);
  EXPECT_EQ(json["rcs_csv_sha256"], "abc");
}

}  // namespace
}  // namespace raytube
