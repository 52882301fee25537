// The text of a case file as a tree of values that know where they were written. The only door to the TOML library.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace raytube {

/// One value of a case. `items` holds the elements of a list or, in the order of `keys`, of a table.
struct CaseValue {
  enum class Kind { boolean, number, text, list, table, other };
  Kind kind = Kind::table;
  std::string location;  // where it is written: "case.toml, line 7" or "--set tubes.max_bounces=3"
  bool boolean = false;
  double number = 0.0;
  std::string text;
  std::vector<std::string> keys;
  std::vector<CaseValue> items;
  bool written_inline = false;  // a { ... } table: an override replaces it as a whole

  /// The entry of a table under `key`, or nullptr.
  const CaseValue* find(std::string_view key) const;
};

/// The entry of the key "section.key", or nullptr.
const CaseValue* find(const CaseValue& root, std::string_view dotted);

/// The same. Throws InputError, which ends with `remedy`, where there is none.
const CaseValue& require(const CaseValue& root, std::string_view dotted, std::string_view remedy);

/// Throws InputError that begins with the location of `value`.
[[noreturn]] void reject(const CaseValue& value, const std::string& sentence);

/// Throws InputError for a `value` that cannot be combined with any of the others (null: not there). It begins with the location
/// of the one that comes from the command line, if there is one, for that is what went wrong, and else with that of `value`.
[[noreturn]] void reject(const CaseValue& value, std::initializer_list<const CaseValue*> others, const std::string& sentence);

/// True for the location of a value from the command line.
bool is_override(std::string_view location);

/// Reads a TOML file, then applies the overrides in order. An override is KEY=VALUE with a dotted key; a VALUE that is not
/// TOML is taken as a string. Throws InputError.
CaseValue read_case_document(const std::filesystem::path& file, const std::vector<std::string>& overrides);

}  // namespace raytube
