// JSON: the order of members, kinds of values, what is refused.
#include "core/json.h"

#include <gtest/gtest.h>

namespace {

using namespace raytube;

TEST(Json, MembersKeepTheOrderInWhichTheyWereAdded) {
  JsonValue value = {{"z", 1}, {"a", "text"}};
  value["m"] = std::vector<double>{0.5, 2.0};
  value["z"] = true;
  EXPECT_EQ(json_text(value, -1), R"({"z":true,"a":"text","m":[0.5,2.0]})");
  EXPECT_EQ(json_text(value, 1), "{\n \"z\": true,\n \"a\": \"text\",\n \"m\": [\n  0.5,\n  2.0\n ]\n}");
}

TEST(Json, TextThatIsReadIsWrittenAgain) {
  for (const char* text : {"null", "true", "18446744073709551615", "-1.5", "94.0", "1e+20", R"("a \"b\"")", "[]", "{}",
                           R"([{"n":[[1],{"x":null}]}])"}) {
    const std::optional<JsonValue> value = parsed_json(text);
    ASSERT_TRUE(value) << text;
    EXPECT_EQ(json_text(*value, -1), text);
  }
}

TEST(Json, BytesThatAreNoTextAreReplaced) { EXPECT_EQ(json_text(JsonValue("a\xff"), -1), "\"a\xEF\xBF\xBD\""); }

TEST(Json, FindsMembersOfTablesOnly) {
  const JsonValue value = {{"a", 7}};
  ASSERT_NE(value.find("a"), nullptr);
  EXPECT_EQ(value.find("a")->whole, 7u);
  EXPECT_EQ(value.find("b"), nullptr);
  EXPECT_EQ(JsonValue("a").find("a"), nullptr);
}

TEST(Json, RefusesWhatIsNoJsonOrHasNoEnd) {
  EXPECT_FALSE(parsed_json(""));
  EXPECT_FALSE(parsed_json("{"));
  EXPECT_FALSE(parsed_json(std::string(100000, '[') + std::string(100000, ']')));
}

}  // namespace
