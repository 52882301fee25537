#include "core/json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace raytube {

namespace {

using Json = nlohmann::ordered_json;
using Kind = JsonValue::Kind;

constexpr int most_levels = 100;

Json written(const JsonValue& value) {
  Json json;
  switch (value.kind) {
    case Kind::null:
      return json;
    case Kind::boolean:
      return value.boolean;
    case Kind::whole:
      return value.whole;
    case Kind::number:
      return value.number;
    case Kind::text:
      return value.text;
    case Kind::list:
      json = Json::array();
      for (const JsonValue& item : value.items) json.push_back(written(item));
      return json;
    case Kind::table:
      json = Json::object();
      for (std::size_t i = 0; i < value.names.size(); ++i) json[value.names[i]] = written(value.items[i]);
      return json;
  }
  return json;
}

std::optional<JsonValue> read(const Json& json, int levels) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_unsigned()) return json.get<std::uint64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get_ref<const std::string&>();
  JsonValue value;
  if (!json.is_structured()) return value;
  if (levels == 0) return std::nullopt;
  value.kind = json.is_array() ? Kind::list : Kind::table;
  for (const auto& entry : json.items()) {
    std::optional<JsonValue> item = read(entry.value(), levels - 1);
    if (!item) return std::nullopt;
    if (json.is_object()) value.names.push_back(entry.key());
    value.items.push_back(std::move(*item));
  }
  return value;
}

}  // namespace

JsonValue::JsonValue(std::initializer_list<JsonMember> members) : kind(Kind::table) {
  for (const JsonMember& member : members) (*this)[member.name] = member.value;
}

JsonValue& JsonValue::operator[](std::string_view name) {
  kind = Kind::table;
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return items[static_cast<std::size_t>(found - names.begin())];
  names.emplace_back(name);
  return items.emplace_back();
}

const JsonValue* JsonValue::find(std::string_view name) const {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? nullptr : &items[static_cast<std::size_t>(found - names.begin())];
}

void JsonValue::append(JsonValue value) {
  kind = Kind::list;
  items.push_back(std::move(value));
}

JsonValue count_or_length(double value) {
  return value == std::floor(value) && value >= 0.0 && value < 1e15 ? JsonValue(static_cast<std::uint64_t>(value))
                                                                    : JsonValue(value);
}

std::string json_text(const JsonValue& value, int indent) {
  return written(value).dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::optional<JsonValue> parsed_json(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  return json.is_discarded() ? std::nullopt : read(json, most_levels);
}

}  // namespace raytube
