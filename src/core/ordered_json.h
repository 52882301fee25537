// JSON whose members keep their order (nlohmann), and the few functions that every user of it needs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace raytube {

using Json = nlohmann::ordered_json;

/// On one line, or with `indent` blanks a level; U+FFFD replaces bytes that are not UTF-8.
std::string text_of_json(const Json& json, int indent = -1);

/// Discarded (is_discarded()) if the text is not JSON.
Json json_of(std::string_view text);

/// The member of that name; nullptr if there is none, or if `json` is not an object.
const Json* find(const Json& json, std::string_view name);

/// The text of that member; empty if there is none.
std::string text_at(const Json& json, std::string_view name);

/// A whole number where the value is one: counts are, lengths have a fraction.
Json count_or_length(double value);

}  // namespace raytube
