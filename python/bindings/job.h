// A case and its target, ready to be solved, checked, traced and drawn.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/interruptible.h"
#include "bindings/target.h"
#include "case/read_case.h"
#include "core/ordered_json.h"
#include "jobs/centres_of_look.h"
#include "output/compare/convergence_report.h"
#include "output/netcdf/stored_result.h"
#include "ranks/ranks.h"
#include "sbr/replay.h"
#include "scene/image.h"

namespace raytube::python {

struct Study {
  std::string text;
  std::vector<DensityResult> results;
  Convergence convergence;
  std::vector<std::string> warnings;  // of rows that must not be used
};

/// Immutable and shared: work on it may outlive the call that began it. Everything throws InputError for bad input and
/// Interrupted once `watch` says stop.
struct Job {
  Case asked;
  std::vector<std::string> mesh_sha256;
  std::shared_ptr<const BuiltTarget> built;

  static std::shared_ptr<const Job> of_file(const std::filesystem::path& file, const std::vector<std::string>& overrides);
  static std::shared_ptr<const Job> of_target(TargetSource& target, const CaseValue& values, const LookNumbers* looks);

  /// Of several ranks each calls it, `threads` 0: so many as it has there. Nothing but for the one that leads.
  std::optional<StoredResult> solve(int threads, bool parts, Watch& watch, Ranks* ranks) const;
  std::optional<Study> converge(const std::vector<double>& densities, int threads, Watch& watch, Ranks* ranks) const;
  Json check(int threads) const;
  LookImage image(std::size_t look, double per_wavelength, int threads, Watch& watch) const;
  LookCentres centres(const CentresAsked& which, int threads, Watch& watch) const;
  TubeTrace trace(std::size_t look, const dvec2& at) const;
};

}  // namespace raytube::python
