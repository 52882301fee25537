// What rays meet on their way: surfaces that end or reflect them, and sheets that they go straight on through.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/trace/tracer.h"
#include "scene/material.h"

namespace raytube {

/// The patches of the sheets that a ray goes through, in the order in which it was looked for.
using SheetsPassed = std::vector<std::uint32_t>;

/// One of the frequencies that materials are given at.
struct RayFrequency {
  std::size_t index;
  double wavenumber;  // [rad/m]
};

/// The surfaces of a target. Keeps references to its arguments.
class RaySurfaces {
 public:
  RaySurfaces(const Tracer& tracer, std::span<const Material> materials) : tracer_(tracer), materials_(materials) {}

  const TriangleMesh& mesh() const { return tracer_.mesh(); }
  const Patch& patch(std::uint32_t index) const { return mesh().patches[index]; }

  /// The sheets from a point of the target to one outside its bounding sphere; none if an opaque surface of other patches than
  /// `own`, two at most, stands between.
  std::optional<SheetsPassed> outwards(const dvec3& point, const dvec3& outside, IgnoredPatches own) const;

  /// The sheets between two points outside the target's bounding sphere; none if an opaque surface stands there.
  std::optional<SheetsPassed> past_target(const dvec3& from, const dvec3& to) const;

  /// The sheets before a patch that the ray meets; none if it does not, or if something opaque comes first.
  std::optional<SheetsPassed> to_patch(Ray ray, std::uint32_t patch) const;

  /// The fields of a wave of direction `d` behind the sheets.
  void pass(std::span<const std::uint32_t> sheets, const RayFrequency& at, const dvec3& d, std::span<ComplexVector> fields) const;

  /// The fields of a wave of direction `d` after reflection at a patch.
  void reflect(std::uint32_t patch, const RayFrequency& at, const dvec3& d, std::span<ComplexVector> fields) const;

 private:
  bool transmits(std::uint32_t patch) const;
  std::optional<SheetsPassed> along(dvec3 point, const dvec3& direction, IgnoredPatches own) const;
  template <class Keep>
  void meet(std::uint32_t patch, const RayFrequency& at, const dvec3& d, std::span<ComplexVector> fields, Keep keep) const;

  const Tracer& tracer_;
  std::span<const Material> materials_;
};

}  // namespace raytube
