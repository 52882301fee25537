// The summary at the end of a run.
#pragma once

#include <span>
#include <string>

#include "scene/options.h"
#include "scene/results.h"

namespace raytube {

/// Facts about a run that its result does not hold.
struct RunFacts {
  std::string size{};  // of the target
  TubeOptions tubes{};
  bool materials = false;  // other than perfect conductors: the numerical error includes truncated tubes
  int threads = 1;
  std::uint64_t looks_resumed = 0;
  std::size_t warnings = 0;
  std::string folder{};
};

/// The sentence about a mechanism that exceeds its bound.
std::string beyond_bound_sentence(const BeyondBound& part);

/// The sentence about lost rays: their number, and the places of the first ones in units of the mesh.
std::string lost_rays_sentence(const Statistics& statistics, double metres_per_unit, const std::string& unit);

/// The largest numerical errors of channels: "at most VV, HH 0.01 dB; ...".
std::string numerical_error_text(const SweepResult& result);

/// Median and largest model uncertainty of channels near the peak.
std::string model_uncertainty_text(const SweepResult& result);

/// The largest part of the model uncertainty, and the remedy against it.
std::string largest_part_text(const ModelPart& largest);

/// Extents of the points along x, y and z, and the same in words: "4 x 2 x 1.5 m; 133 x 66.7 x 50 wavelengths at 10 GHz".
dvec3 size_of(std::span<const dvec3> points);
std::string size_text(const dvec3& size, double frequency);

/// The summary, each line with a name and a value.
std::string summary_text(const SweepResult& result, const RunFacts& facts);

}  // namespace raytube
