// A journal loses nothing that was written whole, and takes nothing that was not.
#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <system_error>

#include "core/error.h"
#include "output/files/files.h"
#include "output/files/journal.h"
#include "scratch.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const JournalIdentity identity{{"tubes.mode", "\"adaptive\""}, {"mesh", "abc"}};

std::string bytes_of(std::uint64_t key) { return std::string(key, static_cast<char>('a' + key)) + '\0'; }

fs::path three_records(const Scratch& scratch) {
  Journal journal(scratch / "j", identity);
  journal.add({{5, bytes_of(5)}});
  journal.add({{0, bytes_of(0)}, {11, bytes_of(11)}});
  return scratch / "j";
}

TEST(Journal, GivesBackWhatWasAdded) {
  const Scratch scratch;
  const auto journal = Journal::reopen(three_records(scratch));
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->identity(), identity);
  EXPECT_EQ(journal->records(), 3u);
  for (const std::uint64_t key : {0, 5, 11}) EXPECT_EQ(journal->find(key), bytes_of(key));
  EXPECT_EQ(journal->find(1), "");
}

TEST(Journal, GoesOnWhereItWasLeft) {
  const Scratch scratch;
  const fs::path file = three_records(scratch);
  Journal::reopen(file)->add({{2, bytes_of(2)}});
  const auto journal = Journal::reopen(file);
  EXPECT_EQ(journal->records(), 4u);
  EXPECT_EQ(journal->find(2), bytes_of(2));
  EXPECT_EQ(journal->find(11), bytes_of(11));
}

// A disk may have taken any part of what was written last.
TEST(Journal, CutAnywhereItHoldsWhatWasWhole) {
  const Scratch scratch;
  const std::string whole = text_of(three_records(scratch));
  std::size_t before = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const auto journal = Journal::reopen(scratch.write("cut", whole.substr(0, size)));
    const std::size_t records = journal ? journal->records() : 0;
    EXPECT_GE(records, before);
    EXPECT_LE(records, before + 1);
    before = records;
    if (!journal) continue;
    for (const std::uint64_t key : {0, 5, 11}) {
      const std::string found = journal->find(key);
      EXPECT_TRUE(found.empty() || found == bytes_of(key));
    }
    journal->add({{3, bytes_of(3)}});
    EXPECT_EQ(Journal::reopen(scratch / "cut")->records(), records + 1);
  }
  EXPECT_EQ(before, 3u);
}

TEST(Journal, AChangedByteEndsIt) {
  const Scratch scratch;
  const std::string whole = text_of(three_records(scratch));
  const std::size_t first = whole.size() - (3 * 24 + 6 + 1 + 12);  // where the first look begins: heads and bytes of three
  for (std::size_t at = first; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    const auto journal = Journal::reopen(scratch.write("changed", changed));
    ASSERT_TRUE(journal);
    EXPECT_LT(journal->records(), 3u) << at;
  }
}

TEST(Journal, OtherFilesAreNone) {
  const Scratch scratch;
  EXPECT_FALSE(Journal::reopen(scratch / "missing"));
  EXPECT_FALSE(Journal::reopen(scratch.write("empty", "")));
  EXPECT_THROW(Journal::reopen(scratch.write("text", "theta_deg,phi_deg\n0,0\n")), InputError);
  EXPECT_THROW(Journal::reopen(scratch.folder()), InputError);
}

TEST(Journal, TellsWhatDiffers) {
  JournalIdentity other = identity;
  EXPECT_THAT(differences(identity, other), ElementsAre());
  other[1].second = "abd";
  const JournalDifference mesh{"mesh", identity[1].second, "abd"};
  EXPECT_THAT(differences(identity, other), ElementsAre(mesh));
  other.emplace_back("edges.order", "2");
  EXPECT_THAT(differences(identity, other), ElementsAre(mesh, JournalDifference{"edges.order", "", "2"}));
  EXPECT_THAT(differences(other, identity),
              ElementsAre(JournalDifference{"mesh", "abd", identity[1].second}, JournalDifference{"edges.order", "2", ""}));
}

// Files of this process end after so many bytes, as on a full disk.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(Journal, AFullDiskCostsOnlyWhatDoesNotFit) {
  const Scratch scratch;
  {
    const SmallDisk disk(1000);
    Journal journal(scratch / "j", identity);
    journal.add({{1, std::string(600, 'x')}});
    EXPECT_THROW(journal.add({{2, std::string(600, 'y')}}), std::system_error);
    EXPECT_EQ(journal.records(), 1u);
    EXPECT_EQ(journal.find(1).size(), 600u);
    journal.add({{3, std::string(100, 'z')}});
  }
  const auto journal = Journal::reopen(scratch / "j");
  ASSERT_TRUE(journal);
  EXPECT_EQ(journal->records(), 2u);
  EXPECT_EQ(journal->find(3), std::string(100, 'z'));
}

TEST(Journal, ALinkIsNone) {
  const Scratch scratch;
  const auto journal = Journal::reopen(three_records(scratch));
  fs::rename(scratch / "j", scratch / "elsewhere");
  fs::create_symlink(scratch / "elsewhere", scratch / "j");
  EXPECT_FALSE(journal->is_there());
  EXPECT_THROW(Journal::reopen(scratch / "j"), InputError);
}

TEST(Journal, ThatCannotBeBegunLeavesNothing) {
  const Scratch scratch;
  const SmallDisk disk(30);
  EXPECT_THROW(Journal(scratch / "j", identity), std::system_error);
  EXPECT_FALSE(fs::exists(scratch / "j"));
  EXPECT_THROW(Journal(scratch / "no-folder/j", identity), std::system_error);
}

TEST(FolderLock, HasOneOwner) {
  const Scratch scratch;
  {
    const OutputFolder first(scratch / "out");
    try {
      const OutputFolder second(scratch / "out");
      FAIL() << "two owners";
    } catch (const InputError& refused) {
      EXPECT_THAT(refused.what(),
                  AllOf(HasSubstr("another raytube (process " + std::to_string(getpid()) + ")"), HasSubstr("-o DIR")));
    }
    EXPECT_TRUE(fs::exists(scratch / "out"));
  }
  EXPECT_FALSE(fs::exists(scratch / "out"));
  { const OutputFolder third(scratch / "out"); }
}

TEST(FolderLock, AFileThatSomebodyLeftMeansNothing) {
  const Scratch scratch;
  scratch.write(".raytube.lock", "1");
  { const OutputFolder folder(scratch.folder()); }
  EXPECT_FALSE(fs::exists(scratch / ".raytube.lock"));
}

// Its target would be overwritten.
TEST(FolderLock, ALinkIsNotFollowed) {
  const Scratch scratch;
  fs::create_symlink(scratch.write("mine.txt", "mine"), scratch / ".raytube.lock");
  try {
    const OutputFolder folder(scratch.folder());
    FAIL() << "followed";
  } catch (const InputError& refused) {
    EXPECT_THAT(refused.what(), AllOf(HasSubstr(".raytube.lock: is a link"), HasSubstr("remove it")));
  }
  EXPECT_EQ(text_of(scratch / "mine.txt"), "mine");
  EXPECT_TRUE(fs::is_symlink(scratch / ".raytube.lock"));
}

TEST(OutputFolder, RemovesWhatKilledProgramsLeft) {
  const Scratch scratch;
  fs::create_directory(scratch / ".results.999999999.part");  // no process has this number
  scratch.write(".results.999999999.part/rcs.csv", "half");
  scratch.write(".probe.999999999.part", "");
  fs::create_directory(scratch / ".results.1.part");  // of a process that lives
  scratch.write(".results.part", "somebody's");
  const OutputFolder folder(scratch.folder());
  EXPECT_FALSE(fs::exists(scratch / ".results.999999999.part"));
  EXPECT_FALSE(fs::exists(scratch / ".probe.999999999.part"));
  EXPECT_TRUE(fs::exists(scratch / ".results.1.part"));
  EXPECT_TRUE(fs::exists(scratch / ".results.part"));
}

}  // namespace
}  // namespace raytube
