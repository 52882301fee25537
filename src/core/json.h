// JSON as a tree of plain values, and its text. The only door to the JSON library.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raytube {

struct JsonMember;

/// One value. `items` holds the elements of a list or, in the order of `names`, the members of a table.
struct JsonValue {
  enum class Kind { null, boolean, whole, number, text, list, table };
  Kind kind = Kind::null;
  bool boolean = false;
  std::uint64_t whole = 0;
  double number = 0.0;
  std::string text;
  std::vector<std::string> names;
  std::vector<JsonValue> items;

  JsonValue() = default;
  JsonValue(bool value) : kind(Kind::boolean), boolean(value) {}
  JsonValue(double value) : kind(Kind::number), number(value) {}
  JsonValue(const char* value) : kind(Kind::text), text(value) {}
  JsonValue(std::string_view value) : kind(Kind::text), text(value) {}
  JsonValue(const std::string& value) : kind(Kind::text), text(value) {}
  JsonValue(std::initializer_list<JsonMember> members);  // a table

  /// Counts and the like, not below 0.
  template <std::integral Integer>
  JsonValue(Integer value) : kind(Kind::whole), whole(static_cast<std::uint64_t>(value)) {}

  /// A list.
  template <class Element>
  JsonValue(const std::vector<Element>& values) : kind(Kind::list), items(values.begin(), values.end()) {}

  /// The member of that name; a table without it, or a null value, gets one that is null.
  JsonValue& operator[](std::string_view name);

  /// The member of that name; nullptr if there is none, or if this is no table.
  const JsonValue* find(std::string_view name) const;

  /// One more element of a list; a null value becomes a list.
  void append(JsonValue value);
};

struct JsonMember {
  std::string_view name;
  JsonValue value;
};

/// A whole number if it is one: counts are, lengths have a fraction.
JsonValue count_or_length(double value);

/// With `indent` blanks a level, or on one line if it is below 0; U+FFFD stands for what is not UTF-8.
std::string json_text(const JsonValue& value, int indent);

/// Nothing if the text is not JSON, or has more than 100 levels of lists and tables.
std::optional<JsonValue> parsed_json(const std::string& text);

}  // namespace raytube
