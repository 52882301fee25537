// A target as Python holds it: polygons, and what was made ready of them, once for many solves.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "case/moving_target.h"
#include "mesh/load.h"
#include "plan/target.h"
#include "scene/sampling.h"

namespace raytube::python {

/// Mesh, wedges and trees for one choice of materials and creases.
struct BuiltTarget {
  MeshReport report;
  Target target;                                         // of a case that moves, that of its plan (jobs/moving.h)
  std::shared_ptr<const MovingTarget> moving = nullptr;  // null: everything stands
  std::vector<dvec3> outermost = outermost_points(target.mesh.vertices);  // as wide as all of it
};

/// What a target is before anything is made ready of it.
struct TargetParts {
  std::string name, unit;
  std::vector<std::string> meshes;  // as a case would list them in target.mesh
  PolygonSoup soup;                 // in units of `unit`
  std::vector<std::string> sha256;  // of the files
};

/// Polygons with the names of their parts. May be used from several threads.
class TargetSource {
 public:
  explicit TargetSource(TargetParts parts) : made_of_(std::move(parts)) {}

  /// Reads the files as one target. Throws InputError.
  TargetSource(const std::vector<std::filesystem::path>& files, std::string unit);

  /// Polygons in units of `unit`; `names`: that of each one's part, or none at all.
  TargetSource(PolygonSoup soup, std::string unit);

  const TargetParts& made_of() const { return made_of_; }

  /// Ready for a case whose [target] is this one. The last few are kept, so that a sweep of anything but materials and creases
  /// builds once. Throws InputError.
  std::shared_ptr<const BuiltTarget> built_for(const Case& c);

 private:
  TargetParts made_of_;
  std::mutex building_;
  std::vector<std::pair<std::string, std::shared_ptr<const BuiltTarget>>> built_;  // what it depends on, the newest last
};

/// A polygon for each row of `corners`, three or more, -1 after the last one.
PolygonSoup soup_of(std::vector<dvec3> vertices, std::vector<std::vector<std::uint32_t>> polygons,
                    const std::vector<std::string>& names);

}  // namespace raytube::python
