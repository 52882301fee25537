// The target in space, as the page of a report takes it: its facets, and for some looks where their return comes from.
#pragma once

#include <array>
#include <vector>

#include "core/json.h"
#include "scene/image.h"
#include "scene/tube_paths.h"

namespace raytube {

/// A look in space.
struct SceneLook {
  LookImage image;  // triangles in the order of the scene's; may be without cells
  TubePaths tubes;  // may be none
};

/// All in the mesh's own coordinates [m].
struct ReportScene {
  std::vector<dvec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<dvec3, 2>> lines;  // edges of the target
  std::vector<SceneLook> looks;
};

/// Cells of an image across on a page, and looks, at most: ten megabytes hold no more.
inline constexpr std::uint32_t most_scene_cells = 200;
inline constexpr std::size_t most_scene_looks = 3;

/// null for a scene without triangles.
JsonValue scene_json(const ReportScene& scene);

}  // namespace raytube
