// The images a case asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "case/case.h"
#include "program/commands.h"

namespace raytube {

/// Throws InputError if an image cannot be made: better now than after the computation.
void check_images(const Target& target, const Case& c);

struct ImageFiles {
  std::vector<std::string> pictures, tables;
  double drawing_s = 0.0;
};

/// Computes and writes them into `folder`, image.* if there is one and image_<look>.* if there are several.
ImageFiles write_images(const std::filesystem::path& folder, const Target& target, const Case& c, int threads);

/// Adds the names of images that an earlier run has left in `folder`.
void add_earlier_images(const std::filesystem::path& folder, ImageFiles& files);

}  // namespace raytube
