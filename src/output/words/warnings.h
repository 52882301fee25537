// What a case asks that its target does not bear out, in sentences: each with the number, the limit and the remedy.
#pragma once

#include <string>
#include <vector>

#include "output/tables/sampled_rows.h"
#include "scene/validity.h"

namespace raytube {

/// One sentence for each kind of feature too small for the methods; of a target too small as a whole only that.
std::vector<std::string> validity_warnings(const Validity& validity);

/// One sentence for each swept quantity.
std::vector<std::string> sampling_warnings(const std::vector<CoarseSteps>& steps);

}  // namespace raytube
