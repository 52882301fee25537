#include "core/ordered_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace raytube {

std::string text_of_json(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

Json json_of(std::string_view text) { return Json::parse(text, nullptr, false); }

const Json* find(const Json& json, std::string_view name) {
  const auto found = json.find(std::string(name));
  return found == json.end() ? nullptr : &*found;
}

std::string text_at(const Json& json, std::string_view name) {
  const Json* value = find(json, name);
  return value && value->is_string() ? value->get<std::string>() : "";
}

Json count_or_length(double value) {
  return value == std::floor(value) && value >= 0.0 && value < 1e15 ? Json(static_cast<std::uint64_t>(value)) : Json(value);
}

}  // namespace raytube
