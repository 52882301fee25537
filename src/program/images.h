// The images a case asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "plan/plan.h"
#include "program/commands.h"
#include "program/work/results.h"

namespace raytube {

/// The files they go to: image.* if there is one, and image_<look>.* with the series image.pvd if there are several.
ResultNames image_names(const Case& c);

/// Files in a folder that earlier images may have left there.
std::vector<std::string> names_of_images(const std::filesystem::path& folder);

/// The tables among these.
std::vector<std::string> image_tables(const Case& c);

/// Computes and writes their tables into `folder`.
void write_images(const std::filesystem::path& folder, const SolvePlan& plan, const Case& c);

}  // namespace raytube
