// Media with published permittivities: docs/media.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/layers.h"

namespace raytube {

std::vector<std::string> library_names();

/// Nothing if the library has none of this name. Throws InputError (a sentence without a place) if its source does not cover the
/// frequency.
std::optional<Medium> library_medium(std::string_view name, double frequency_hz);

}  // namespace raytube
