// Results of commands that left no list of them.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>

namespace raytube {

/// Names of the results in a folder whose command left no list: a version before it, or a copy that somebody has made without
/// hidden files. Only what such a result says of itself tells it. `listed` says whether a name is on the list after all.
std::set<std::string> unlisted_results(const std::filesystem::path& folder,
                                       const std::function<bool(const std::string&)>& listed);

/// What lies in a folder under the name of an image.
std::set<std::string> names_of_images(const std::filesystem::path& folder);

}  // namespace raytube
