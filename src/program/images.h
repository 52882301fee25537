// The images that a case asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "plan/plan.h"
#include "program/work/results.h"

namespace raytube {

/// The files of the images: image.* for one, image_<look>.* and the series image.pvd for several.
ResultNames image_names(const Case& c);

/// Files in the folder that may be earlier images.
std::vector<std::string> names_of_images(const std::filesystem::path& folder);

/// The tables among the files of the images.
std::vector<std::string> image_tables(const Case& c);

/// Computes the images and writes their tables into `folder`.
void write_images(const std::filesystem::path& folder, const SolvePlan& plan, const Case& c);

}  // namespace raytube
