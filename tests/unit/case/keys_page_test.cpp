// The page on case keys against the list that the program reads them by.
#include <fmt/format.h>

#include <fstream>
#include <type_traits>

#include "case/data/case_keys.h"
#include "case/data/names.h"
#include "unit/case_text.h"
#include "core/decimal.h"

namespace raytube {
namespace {

using namespace raytube::testing;

std::string default_text(bool value, const CaseKey&) { return value ? "true" : "false"; }
std::string default_text(int value, const CaseKey&) { return std::to_string(value); }
std::string default_text(double value, const CaseKey& key) {
  return number_text(key.factor == degree ? decimal_degrees(value) : value);
}
std::string default_text(const Use&, const CaseKey&) { return "`\"auto\"`"; }
template <class Choice>
requires std::is_enum_v<Choice> std::string default_text(Choice choice, const CaseKey&) {
  return fmt::format("`\"{}\"`", word_of(choice));
}
// Keys whose default the member does not say have a text for it.
std::string default_text(const std::vector<std::size_t>&, const CaseKey&) { return ""; }
std::string default_text(const std::optional<dvec3>&, const CaseKey&) { return ""; }

// The columns of a row, up to what the key means.
template <class Member>
std::string beginning(const CaseKey& key, const Member& member) {
  return fmt::format("\n| `{}` |{} | {} | ", key.name, key.unit.empty() ? "" : fmt::format(" {}", key.unit),
                     key.by_default.empty() ? default_text(member, key) : std::string(key.by_default));
}

TEST(CaseKeysPage, HasEveryKeyAsTheProgramHasIt) {
  std::ifstream file(RAYTUBE_SOURCE_DIR "/docs/reference/case_keys.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const std::string_view name : shaped_key_names())
    EXPECT_TRUE(name == "materials" || page.find(fmt::format("`{}", name)) != std::string::npos) << name;
  visit_case_keys(static_cast<const Case&>(Case()), [&](const CaseKey& key, const auto& member) {
    const std::string columns = beginning(key, member);
    const std::size_t at = page.find(columns);
    ASSERT_NE(at, std::string::npos) << "docs/reference/case_keys.md has no line" << columns;
    const std::string meaning = page.substr(at + columns.size(), page.find('\n', at + columns.size()) - at - columns.size());
    if (key.limits.hold(-1e300) && key.limits.hold(1e300)) return;
    EXPECT_THAT(meaning, ::testing::HasSubstr("(" + key.limits.text() + ")")) << key.name;
  });
}

}  // namespace
}  // namespace raytube
