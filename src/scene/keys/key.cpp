#include "scene/keys/key.h"

#include <fmt/format.h>

#include <cmath>

namespace raytube {

bool Limits::hold(double number) const {
  return (above ? number > least : number >= least) && (below ? number < most : number <= most);
}

std::string Limits::text() const {
  if (std::isfinite(least) && std::isfinite(most) && !above && !below) return fmt::format("from {:g} to {:g}", least, most);
  const std::string low = fmt::format("{} {:g}", above ? "greater than" : "at least", least),
                    high = fmt::format("{} {:g}", below ? "less than" : "at most", most);
  return !std::isfinite(most) ? low : !std::isfinite(least) ? high : low + " and " + high;
}

}  // namespace raytube
