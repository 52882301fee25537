// The keys a case file may hold.
#pragma once

#include <span>

#include "case/document.h"

namespace raytube {

/// Throws InputError at the first key that is unknown (naming the nearest known one) or that later versions will know.
void check_case_keys(const CaseValue& root);

/// The one of `known` dotted keys that `key` was most likely meant to be.
std::string_view nearest_key(std::string_view key, std::span<const std::string_view> known);

}  // namespace raytube
