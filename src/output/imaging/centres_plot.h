// Scattering centres as a picture.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>

#include "imaging/centres.h"

namespace raytube {

/// The lines of a picture over it: of the case, and of the look.
struct CentresHeading {
  std::string title, look;
};

/// Draws centres.png and centres.svg in `folder`, which holds neither: cross-range of the look to the right, range upwards, the
/// target's lines, given by their ends in the mesh's coordinates, and the centres within 40 dB of the strongest as dots, the
/// first ten with their numbers. Returns an empty text, or why there is no picture.
std::string plot_centres(const std::filesystem::path& folder, const CentresHeading& heading, const ScatteringCentres& found,
                         const LookAxes& axes, std::span<const std::array<dvec3, 2>> target_lines);

}  // namespace raytube
