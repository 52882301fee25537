// Rows beyond their bound end in exit code 4, with the results written and the rows named. No sound solve has any: here finished
// looks that a stopped run has left are made larger than their target allows, and taken up again.
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "output/files/journal.h"
#include "program.h"
#include "solve/look_result.h"

namespace raytube {
namespace {

namespace fs = std::filesystem;
using namespace raytube::testing;
using ::testing::HasSubstr;

constexpr std::size_t looks = 9001;
const std::string minutes =
    "case.toml --set target.unit=m --set tubes.mode=uniform --set edges.method=none --set output.plots=false --set "
    "'look.phi_deg={start=0,stop=90,step=0.01}' ";
const std::string journal = "out/.raytube.journal";

class UnusableRows : public BadInput {
 protected:
  void stop_once_looks_are_kept() const {
    const std::string command = "cd '" + scratch.folder().string() + "'; (exec " + RAYTUBE_PROGRAM " run " + minutes +
                                ">stdout.txt 2>stderr.txt) & run=$!; while ! [ -s " + journal +
                                " ]; do sleep 0.1; done; kill -INT $run; wait $run";
    ASSERT_EQ(WEXITSTATUS(std::system(command.c_str())), 130);
  }

  // Fills the journal with the first kept look, in which `spoil` has changed one.
  void fill_journal(const std::function<void(LookResult&)>& spoil) const {
    const auto file = Journal::reopen(scratch / journal);
    std::uint64_t first = 0;
    while (first + 1 < looks && file->find(first).empty()) ++first;
    ASSERT_FALSE(file->find(first).empty());
    LookResult look = look_of_bytes(file->find(first), 1, mechanism_list().size()).value();
    std::vector<JournalRecord> records;
    for (std::uint64_t i = 0; i < looks; ++i) records.push_back({i, look_bytes(look)});
    spoil(look);
    records[spoilt].bytes = look_bytes(look);
    file->add(records);
  }

  void expect_told(const std::string& sentence) const {
    const Outcome outcome = raytube("run " + minutes + "--resume");
    EXPECT_EQ(outcome.code, 4) << outcome.complaint;
    EXPECT_THAT(outcome.complaint, HasSubstr("the first bounce: 1 row " + sentence));
    EXPECT_THAT(outcome.complaint,
                HasSubstr("out: the results are written, but hold rows that must not be used, as reported above\n"));
    EXPECT_TRUE(fs::exists(scratch / "out/rcs.csv"));
    EXPECT_FALSE(fs::exists(scratch / journal));
    const auto beyond = nlohmann::json::parse(text_of(scratch / "out/run.json"))["counts"]["beyond_bound"];
    ASSERT_EQ(beyond.size(), 1u);
    EXPECT_EQ(beyond[0]["worst_row"], spoilt);
  }

  static constexpr std::size_t spoilt = 4321;
};

TEST_F(UnusableRows, BeyondTheirBound) {
  stop_once_looks_are_kept();
  fill_journal([](LookResult& look) { look.tubes.bounces[0][0] *= 1e6; });
  expect_told("with more than the size of the target allows, row 4321 by");
}

TEST_F(UnusableRows, WithoutANumber) {
  stop_once_looks_are_kept();
  fill_journal([](LookResult& look) { look.tubes.bounces[0][0] *= std::numeric_limits<double>::quiet_NaN(); });
  expect_told("without a number or beyond its bound, row 4321 first");
}

}  // namespace
}  // namespace raytube
