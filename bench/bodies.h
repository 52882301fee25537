// What is solved in the studies.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "case/read_case.h"
#include "solve/solve.h"

namespace raytube::bench {

/// A target and the looks at it.
struct Body {
  Body(std::string title, LoadedMesh&& loaded, Sweep looks)
      : name(std::move(title)), sweep(std::move(looks)), target(std::move(loaded.mesh), {.thin_plates = false}) {}

  std::string name;
  Sweep sweep;
  Target target;
};

/// Monostatic looks from (theta, phi) [deg] at these frequencies [Hz].
Sweep looks_from(std::vector<double> frequencies, std::initializer_list<std::pair<double, double>> degrees);
/// Four looks at an upright dihedral, in its plane and off its bisector.
Sweep dihedral_looks(std::vector<double> frequencies);
/// `count` looks of an even walk over azimuth, at elevations that suit a vehicle or a corner.
Sweep looks_round(double frequency, int count);

/// A case of the repository (file relative to the source folder) as it stands but for `tubes.mode`.
Case repository_case(const std::string& file, const std::string& mode);
LoadedMesh repository_mesh(const std::string& case_file);

/// Tubes over the cells of a uniform grid, edges off, nothing skipped.
SolveOptions uniform(double per_wavelength, int threads);
/// Adaptive tubes that end exactly at edges, edges off, refined until their estimated error is below `tolerance_db` or cells
/// reach `most_per_wavelength`. Facets are kept flat unless `curved`.
SolveOptions adaptive(double tolerance_db, int threads, bool curved = false, double most_per_wavelength = 40.0);

/// What one run gave.
struct Outcome {
  std::vector<ScatteringMatrix> scattering;
  std::uint64_t rays = 0;
  double seconds = 0.0;
};
Outcome solved(const Body& body, const Sweep& sweep, const SolveOptions& options);

using Run = std::function<Outcome(int repeat)>;
/// Every run `repeats` times, in turn, so that whatever disturbs the machine meets all alike; [run][repeat].
std::vector<std::vector<Outcome>> in_turn(const std::vector<Run>& runs, int repeats);
double median_seconds(const std::vector<Outcome>& outcomes);

}  // namespace raytube::bench
