// What is to be said of the tubes of a look.
#pragma once

#include <string>

#include "scene/tube_paths.h"

namespace raytube {

/// Lines: how many were followed, how many hits there were at each bounce, and how they ended.
std::string tubes_text(const TubePaths& tubes, const FacetHits& hits);

}  // namespace raytube
