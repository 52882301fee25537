// The keys a case file may hold.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "case/text/document.h"

namespace raytube {

/// Throws InputError at the first key that is unknown, naming what raytube has in its place, a near one, or all there are.
void check_case_keys(const CaseValue& root);

/// The one of `known` dotted keys that `key` was most likely meant to be; empty if none is near.
std::string_view nearest_key(std::string_view key, std::span<const std::string_view> known);

/// The one of `known` names, of which there is at least one, that `name` was most likely meant to be; empty if none is near.
std::string_view nearest_name(std::string_view name, std::span<const std::string> known);

/// 'did you mean "NAME"?' for a near one, else "choose among" the first ones of all.
std::string name_meant(std::string_view name, std::span<const std::string> known);

}  // namespace raytube
