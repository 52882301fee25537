// The words at the end of a run.
#pragma once

#include <span>
#include <string>

#include "scene/options.h"
#include "scene/results.h"

namespace raytube {

/// What of a run the result does not tell.
struct RunFacts {
  std::string size{};  // of the target
  TubeOptions tubes{};
  bool materials = false;  // other than perfect conductors: the numerical error holds what truncated tubes may bring
  bool random = false;     // the mean of random tubes, whose error is told elsewhere
  int threads = 1;
  std::uint64_t looks_resumed = 0;
  std::size_t warnings = 0;
  std::string folder{};
};

/// What is to be said, once a solve is done, of a mechanism that exceeds its bound.
std::string beyond_bound_sentence(const BeyondBound& part);

/// What is to be said of lost rays: how many, and where the first ones were in units of the mesh.
std::string lost_rays_sentence(const Statistics& statistics, double metres_per_unit, const std::string& unit);

/// The largest numerical errors of channels: "at most VV, HH 0.01 dB; ...".
std::string numerical_error_text(const SweepResult& result);

/// Median and largest model uncertainty of channels near the peak.
std::string model_uncertainty_text(const SweepResult& result);

/// What the model uncertainty mostly is, and the handle that makes it less.
std::string largest_part_text(const ModelPart& largest);

/// Extents along x, y and z: of the points, and in words "4 x 2 x 1.5 m; 133 x 66.7 x 50 wavelengths at 10 GHz".
dvec3 size_of(std::span<const dvec3> points);
std::string size_text(const dvec3& size, double frequency);

/// Lines of a name and what is to be said of it.
std::string summary_text(const SweepResult& result, const RunFacts& facts);

}  // namespace raytube
