// Media with published permittivities: docs/reference/media.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/layers.h"

namespace raytube {

/// The names of the media that the library has.
std::vector<std::string> library_names();

/// Relative permittivity and permeability of a medium at a frequency [Hz]; nothing if the library has none of this name. Throws
/// InputError, a sentence without a location, if the published source does not cover the frequency.
std::optional<Medium> library_medium(std::string_view name, double frequency_hz);

}  // namespace raytube
