// How sigma is distributed: the laws that radar targets are described by, fitted to the rows of a result.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace raytube {

/// Laws of sigma = s with mean m.
///   Swerling I:   p(s) = exp(-s / m) / m, chi-square of 2 degrees of freedom: many scatterers alike
///   Swerling III: p(s) = 4 s / m^2 exp(-2 s / m), chi-square of 4: one large one among many small ones
///   chi-square:   p(s) = (k s / m)^(k - 1) exp(-k s / m) k / (m Gamma(k)), of 2 k degrees of freedom, any k > 0
///   log-normal:   ln s is normal
/// Swerling, RAND RM-1217 (1954), also IRE Trans. IT-6 (1960) 269; any k: Weinstock 1964, Meyer and Mayer, Radar Target Detection
/// (1973), and Swerling, IEEE Trans. AES-33 (1997).
enum class Law { swerling_1, swerling_3, chi_square, log_normal };
inline constexpr std::array<const char*, 4> law_titles = {"Swerling I", "Swerling III", "chi-square", "log-normal"};
inline constexpr std::array<const char*, 4> law_names = {"swerling_1", "swerling_3", "chi_square", "log_normal"};

struct LawFit {
  Law law;
  double mean_m2;               // of the law
  double shape;                 // k; NaN for log-normal
  double middle_db, spread_db;  // mean and standard deviation of 10 lg sigma; NaN for the others
  double distance;              // of Kolmogorov and Smirnov: the largest difference between the shares below a level

  /// The share that the law has below a level.
  double below(double dbsm) const;
};

/// The four laws with their likeliest parameters, for levels of sigma; zeros are left out. None for fewer than ten levels, or
/// levels that are all alike.
std::vector<LawFit> fitted_laws(std::span<const double> dbsm);

/// The law with the least distance.
const LawFit& nearest_law(const std::vector<LawFit>& laws);

/// The likeliest shape of a chi-square law: ln k - psi(k) = log_spread, which is the logarithm of the mean less the mean of the
/// logarithms (Johnson, Kotz and Balakrishnan, Continuous Univariate Distributions 1, 1994, ch. 17). log_spread > 0.
double likeliest_shape(double log_spread);

/// psi(x) for x > 0 (Abramowitz and Stegun 6.3.5, 6.3.18).
double digamma(double x);

/// P(k, x), the share of a gamma law of this shape below x (Abramowitz and Stegun 6.5.29, 6.5.31).
double gamma_below(double k, double x);

}  // namespace raytube
