// Studies over the density of uniform tubes: what they ask of a case.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "case/data/case.h"
#include "solve/solve.h"

namespace raytube {

/// Sorted. Throws InputError, which begins with `asked`, for fewer than three, for equal ones, and for more than 100.
std::vector<double> densities_from_coarse_to_fine(std::vector<double> densities, const std::string& asked);

/// Throws InputError for a case without tubes.
void refuse_study_of_rays(const Case& c);

/// How the case is solved, but for tubes.per_wavelength: adaptive tubes have no density to study, so the study is of uniform
/// ones.
SolveOptions options_of_study(const Case& c, int threads);

/// Throws InputError now for what the last density would be refused for after hours: of `asked`, and for want of memory. The
/// amplitudes of every density are kept to the end.
void check_study(const Case& c, const Target& target, int threads, const std::vector<double>& densities,
                 const std::string& asked);

/// One density of a study, solved.
struct SolvedDensity {
  double per_wavelength;
  SweepResult result;
};

/// Solves the case at one density after the other, beside others of a `team` (null: alone). `progress` gets the share of the
/// whole study and stops it by false, `solved` each density: not on those that help.
void study_densities(const Case& c, const Target& target, int threads, std::span<const double> densities,
                     const std::function<bool(double)>& progress, WorkTeam* team,
                     const std::function<void(SolvedDensity)>& solved);

/// The finished share of a study's work once so many densities are `done`, and of the next one `of_next`: tubes grow with the
/// square of the density.
double finished_share(std::span<const double> densities, std::size_t done, double of_next);

}  // namespace raytube
