// Case file of `raytube sources` (TOML) -> SourceCase: strict keys, units converted, every default resolved.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesh/model/geometry.h"
#include "point_source/source_study.h"

namespace raytube {

struct ScenePart {
  std::string name;
  std::filesystem::path mesh_file;
  double metres_per_unit = 1.0;
  RaySurface surface = RaySurface::pec;
};

struct SourceCase {
  std::string title;
  std::filesystem::path file;
  std::vector<ScenePart> parts;
  std::optional<Box> box;  // default: the bounding box of the parts
  std::vector<dvec3> points;
  std::vector<LaunchModel> models;
  std::vector<std::uint64_t> rays;  // ascending
  std::uint64_t seed = 1;
  int wall = 0;  // of the box, from which a plane wave starts
  int max_reflections = 10;
  std::size_t counted = 0;  // the part whose hits are shown
  bool plots = true;
};

/// The files that the case is read from, each with the key that names it.
std::vector<std::pair<std::string, std::filesystem::path>> input_files(const SourceCase& c);

/// Reads a case; `overrides` as of read_case. Throws InputError with file, line or key, and the remedy.
SourceCase read_source_case(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

}  // namespace raytube
