#include "stress/stability.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

namespace raytube::testing {

namespace {

std::vector<Stability>& rows() {
  static std::vector<Stability> all;
  return all;
}

std::string table() {
  std::string text = size_of_run("Of the quick suite.\n\n", "Of the full suite.\n\n");
  text += "| what changes | targets | worst | allowed | because |\n|---|---|---|---|---|\n";
  for (const Stability& row : rows())
    text += fmt::format("| {} | {} | {:.1e} | {:.0e} | {} |\n", row.change, row.targets, row.worst, row.allowed, row.reason);
  return text;
}

bool all_tests_run() {
  const auto& unit = *::testing::UnitTest::GetInstance();
  return unit.test_to_run_count() == unit.total_test_count();
}

// Replaces what stands between two lines of a document.
void replace_table(const std::string& file) {
  ASSERT_TRUE(all_tests_run()) << file
                               << " stays as it is: a filter leaves out tests that have rows in the table; run all of them";
  static const std::string begin = "<!-- table of the stress suite -->\n", end = "<!-- end of table -->\n";
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t from = text.find(begin), to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos) << file << " has no place for the table";
  text.replace(from + begin.size(), to - from - begin.size(), table());
  std::ofstream(file) << text;
}

class TableWriter : public ::testing::Environment {
 public:
  void TearDown() override {
    if (const char* file = std::getenv("RAYTUBE_STABILITY_TABLE")) replace_table(file);
  }
};

[[maybe_unused]] const auto* const writer = ::testing::AddGlobalTestEnvironment(new TableWriter);

}  // namespace

void expect_stable(const Stability& measured) {
  EXPECT_LE(measured.worst, measured.allowed) << measured.change << " (" << measured.targets << ")";
  rows().push_back(measured);
}

}  // namespace raytube::testing
