#include "scene/results.h"

#include <fmt/format.h>

namespace raytube {

std::string reason_of(const Skipped& skipped) {
  const bool has_figure = skipped.why.find("{:.2g}") != std::string::npos;
  return has_figure ? fmt::format(fmt::runtime(skipped.why), skipped.figure) : skipped.why;
}

}  // namespace raytube
