// Which facets of the target have which material: [target] material, [target.parts] and [target.facets].
#pragma once

#include <string>
#include <vector>

#include "case/data/case.h"
#include "case/text/document.h"

namespace raytube {

/// Reads all three; `names` are those of the materials that there are. Throws InputError.
MaterialAssignment read_material_assignment(const CaseValue& root, const std::vector<std::string>& names);

}  // namespace raytube
