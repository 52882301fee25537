// What the target is made of: [materials], and in [target] which material is where.
#pragma once

#include "case/case.h"
#include "case/document.h"

namespace raytube {

/// Fills c.places, c.materials and c.sweep.materials; frequencies must be known already. Throws InputError.
void read_materials(const CaseValue& root, Case& c);

/// Which material is where; `names` are those there are.
MaterialPlaces read_places(const CaseValue& root, const std::vector<std::string>& names);

/// The names of those that are defined, but that nothing in [target] has.
std::vector<std::string> unused_materials(const Case& c);

/// The names of materials that every case knows.
inline constexpr std::array<const char*, 2> own_materials = {"pec", "absorber"};

}  // namespace raytube
