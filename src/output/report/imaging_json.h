// Range profiles and images as the page of a report takes them.
#pragma once

#include "core/json.h"
#include "imaging/isar.h"
#include "imaging/range_profile.h"

namespace raytube {

/// sigma over range of every look, or of blocks of them.
JsonValue profiles_json(const RangeProfiles& profiles, std::size_t looks, const Window& window);

/// sigma over range and cross-range, of an image in space the strongest along its third axis.
JsonValue isar_json(const IsarImage& image, const Window& window);

}  // namespace raytube
