// The keys a case file may hold.
#pragma once

#include <span>

#include "case/text/document.h"

namespace raytube {

/// Throws InputError at the first key that is unknown, naming the nearest known one.
void check_case_keys(const CaseValue& root);

/// The one of `known` dotted keys that `key` was most likely meant to be.
std::string_view nearest_key(std::string_view key, std::span<const std::string_view> known);

/// The name with capitals made small (ASCII).
std::string lower_case(std::string_view name);

/// The one of `known` names, of which there is at least one, that `name` was most likely meant to be.
std::string_view nearest_name(std::string_view name, std::span<const std::string> known);

}  // namespace raytube
