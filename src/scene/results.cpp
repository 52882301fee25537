#include "scene/results.h"

#include <fmt/format.h>

namespace raytube {

std::string reason_of(const Skipped& skipped) { return fmt::format(fmt::runtime(skipped.why), skipped.figure); }

}  // namespace raytube
