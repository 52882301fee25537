// Tables from anywhere: separators, comments, locations of mistakes.
#include "core/csv_reader.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> second_row(const std::string& text) {
  const Scratch scratch;
  CsvReader reader(scratch.write("t.csv", text), "");
  EXPECT_THAT(reader.columns(), ElementsAre("a", "b"));
  EXPECT_TRUE(reader.next());
  EXPECT_TRUE(reader.next());
  return {reader.cell(0), reader.cell(1)};
}

TEST(CsvReader, CommasSemicolonsTabsAndBlanks) {
  for (const char* text : {"a,b\n1,2\n3,4\n", "a;b\n1;2\n3;4", "a\tb\r\n1\t2\r\n3\t4\r\n", "  a   b\n 1 2 \n\n 3    4\n"})
    EXPECT_THAT(second_row(text), ElementsAre("3", "4")) << text;
}

TEST(CsvReader, CommentsQuotesAndAByteOrderMarkAreDropped) {
  EXPECT_THAT(second_row("\xEF\xBB\xBF# words, words\n\"a\", \"b\"\n1,2\n# more\n\"3\" ,4\n"), ElementsAre("3", "4"));
  EXPECT_THAT(second_row("a,b\n1,\n,\n"), ElementsAre("", ""));
}

TEST(CsvReader, SeparatorsBetweenQuotesAreOfTheirCell) {
  EXPECT_THAT(second_row("a,b\n1,2\n3,\"far, side\"\n"), ElementsAre("3", "far, side"));
  EXPECT_THAT(second_row("a;b\n1;2\n4\";5\n"), ElementsAre("4", "5"));  // a quote inside is none
}

TEST(CsvReader, MistakesHaveTheirPlace) {
  const Scratch scratch;
  CsvReader reader(scratch.write("t.csv", "# c\na,b\n1,x\n1,2,3\n"), "");
  EXPECT_THAT(reader.location(), HasSubstr("t.csv, line 2"));
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(reader.finite_number(0, ""), 1.0);
  const auto complaint = [&](auto action) -> std::string {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(complaint([&] { reader.finite_number(1, "write it so"); }),
              HasSubstr("t.csv, line 3, column b: \"x\" is not a finite number; write it so"));
  EXPECT_THAT(complaint([&] { reader.next(); }), HasSubstr("t.csv, line 4: 3 values where the header names 2 columns"));
  EXPECT_THAT(complaint([&] { CsvReader(scratch / "none.csv", "give another"); }),
              HasSubstr("none.csv: cannot be read; give another"));
  EXPECT_THAT(complaint([&] { CsvReader(scratch.folder(), "give another"); }), HasSubstr("cannot be read"));
}

TEST(CsvReader, NumbersAreWholeCells) {
  EXPECT_EQ(parsed_number("+1.5e3"), 1500.0);
  EXPECT_EQ(parsed_number("-inf"), -std::numeric_limits<double>::infinity());
  for (const char* text : {"", "1 2", "1,5", "0x10", "1e999", "ten"}) EXPECT_FALSE(parsed_number(text)) << text;
}

TEST(CsvReader, AnEmptyFileHasNoColumns) {
  const Scratch scratch;
  CsvReader reader(scratch.write("t.csv", "# nothing\n\n"), "");
  EXPECT_TRUE(reader.columns().empty());
  EXPECT_FALSE(reader.next());
}

}  // namespace
}  // namespace raytube
