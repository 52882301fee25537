// Sums of many waves at many wavenumbers, each wave known at a few.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "math/chebyshev.h"

namespace raytube {

/// Adds up S = sum of A(k) e^{jkL}, the amplitudes analytic in k but for k = 0. Waves of about the same path L are added up at
/// Chebyshev wavenumbers with their phases counted from the middle of that bin of paths; each bin is expanded to all wavenumbers
/// once. Error of about 1e-7 of the sum of |A|. Where wavenumbers are few, waves are evaluated at each of them. One thread's.
class BandSum {
 public:
  /// `every_one`: no wavenumber is interpolated.
  explicit BandSum(std::span<const double> wavenumbers, bool every_one = false);

  /// Where waves are to be evaluated whose phases are those of paths up to `half_span` [m] beside the one they are filed under.
  std::span<const double> nodes(double half_span) { return class_of(half_span).at; }

  struct Bin {
    std::span<const double> at;       // wavenumbers [rad/m]
    double path;                      // from which phases are to be counted [m]
    std::span<ScatteringMatrix> sum;  // to add to, by wavenumber
  };
  /// For a wave of that path; valid until the next one.
  Bin bin(double path, double half_span);

  /// A smooth amplitude without phase, at every wavenumber.
  template <class Amplitude>
  std::vector<Complex> everywhere(Amplitude amplitude) {
    std::vector<Complex> values;
    for (const double k : nodes(0.0)) values.push_back(amplitude(k));
    return interpolated(values);
  }

  /// What has been added up, at every wavenumber.
  void add_to(std::span<ScatteringMatrix> sum) const;

 private:
  /// Waves of up to the same half span.
  struct Class {
    std::span<const double> at;
    const ChebyshevNodes* nodes;  // null: every wavenumber
    double width;                 // of its bins [m]
    std::map<long long, std::vector<ScatteringMatrix>> bins{};
  };
  Class& class_of(double half_span);
  std::vector<Complex> interpolated(const std::vector<Complex>& values);
  void expand(const Class& group, double path, std::span<const ScatteringMatrix> values, std::span<ScatteringMatrix> sum) const;

  Band band_;
  bool every_one_;
  std::map<int, Class> classes_;  // by the binary logarithm of their half spans
};

}  // namespace raytube
