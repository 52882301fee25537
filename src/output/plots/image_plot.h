// An image of a look as pictures: four panels each.
#pragma once

#include <filesystem>
#include <string>

#include "scene/image.h"
#include "scene/sweep.h"

namespace raytube {

/// Draws in `folder`, which holds none of them: `name`.png, sigma of the cells; `name`_phase.png, their phase; and
/// `name`_window.png, sigma of what is left when the cells within some wavelengths interfere. Returns an empty text, or why there
/// is no picture.
std::string draw_image(const std::filesystem::path& folder, const std::string& name, const std::string& title, const Sweep& sweep,
                       LookImage image);

}  // namespace raytube
