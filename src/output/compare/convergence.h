// A sweep solved with finer and finer tubes: how fast it converges, to what, and which density is fine enough.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/sweep.h"

namespace raytube {

/// A density is fine enough when its estimated rms error is below this, over the rows within 20 dB of their channel's peak [dB].
inline constexpr double fine_enough_db = 0.1;

/// The sweep at one density.
struct DensityResult {
  double per_wavelength;
  std::uint64_t tubes, rays;
  double solve_s;  // NaN: not known
  std::vector<ScatteringMatrix> total;
};

/// What is known about one density; NaN where nothing is. Norms are over all rows and channels: sqrt(sum |S|^2).
struct DensityErrors {
  double norm;                     // [m]
  double change, relative_change;  // to the next density: of the complex difference [m], and divided by the finest one's norm
  double order;                    // observed with this density and the two before
  double relative_error;           // estimated, of complex S
  double rms_db;                   // estimated, the worst channel's
};

/// Of the last three densities.
struct Extrapolation {
  double order;                         // observed; NaN where the densities agree to rounding
  double mean_order;                    // of all densities: single ones scatter, as the errors of a staircase do
  std::vector<ScatteringMatrix> total;  // Richardson's value for endless density
  double relative_uncertainty;          // of it, over all rows and channels
  double strongest_uncertainty;         // of it, in the strongest row and channel [m]
  double next_density;                  // if none is fine enough: the one that the order promises to be
};

struct Convergence {
  std::vector<DensityErrors> densities;
  std::size_t strongest_row = 0;  // of the finest density
  int strongest_channel = 0;
  std::optional<Extrapolation> extrapolation;  // from three densities on
  std::optional<std::size_t> recommended;      // the coarsest that is fine enough, as all finer ones are
};

/// Of densities from coarse to fine, at least one.
///
/// The errors e1, e2, e3 of three densities n1 < n2 < n3 are taken to be as large as n^-p and to have the correlation rho, 0 to
/// 1, with one another (over all rows and channels): 1 when they are parallel, as Richardson supposes, 0 when they are
/// independent, as those of a staircase nearly are. With the changes D1 = S2 - S1, D2 = S3 - S2 and A = (n2/n1)^p, B = (n3/n2)^p:
///
///     order         ||D2|| / ||D1|| = (n2^-p - n3^-p) / (n1^-p - n2^-p)  (Roache 1998; for n2/n1 = n3/n2 whatever rho)
///     correlation   Re<D1, D2> / ||D1||^2 = (rho (1/B - A/B + A) - 1) / (1 + A^2 - 2 rho A)
///     finest        ||e3|| = ||D2|| / sqrt(1 + B^2 - 2 rho B)
///     extrapolated  S3 + w D2 with the least-squares weight w = (rho B - 1) / (1 + B^2 - 2 rho B)
///
/// For rho = 1 these are Richardson's ||D2|| / (B - 1) and w = 1 / (B - 1). The extrapolated value gets the finest one's error as
/// its uncertainty. In all but the first p is kept within 0.5 and 2, the order of a smooth integrand: beyond that it is chance.
Convergence study_convergence(std::span<const DensityResult> results);

}  // namespace raytube
