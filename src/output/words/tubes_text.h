// The tubes of a look in words.
#pragma once

#include <string>

#include "scene/tube_paths.h"

namespace raytube {

/// Lines with the number of tubes followed, the hits at each bounce, and the ends of the tubes.
std::string tubes_text(const TubePaths& tubes, const FacetHits& hits);

}  // namespace raytube
