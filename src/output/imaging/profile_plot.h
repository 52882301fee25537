// Range profiles as pictures.
#pragma once

#include <filesystem>
#include <string>

#include "imaging/range_profile.h"
#include "output/netcdf/stored_result.h"

namespace raytube {

/// Draws in `folder`, which holds none of them: profile.png and .svg of the look with the strongest range, and of several looks
/// waterfall.png and .svg, range by look: by angle where one angle alone varies, else by the look's number. Returns an empty
/// text, or why there is no picture.
std::string plot_profiles(const std::filesystem::path& folder, const std::string& title, const StoredResult& result,
                          const RangeProfiles& profiles);

}  // namespace raytube
