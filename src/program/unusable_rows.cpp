#include "program/unusable_rows.h"

#include <fmt/format.h>

#include "output/words/summary.h"
#include "program/work/results.h"

namespace raytube {

bool warn_of_unusable_rows(const Statistics& statistics) {
  for (const BeyondBound& part : statistics.beyond_bound) warn(beyond_bound_sentence(part));
  return !statistics.beyond_bound.empty();
}

std::runtime_error unusable_rows_in(const std::filesystem::path& folder) {
  return std::runtime_error(
      fmt::format("{}: the results are written, but hold rows that must not be used, as said above", folder.string()));
}

}  // namespace raytube
