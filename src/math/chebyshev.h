// Many wavenumbers from a few: sums of waves over a short stretch of path are known from their values at Chebyshev points.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Chebyshev points of the first kind on the interval of some wavenumbers, and the weights of the barycentric formula there.
struct ChebyshevNodes {
  std::vector<double> at;       // the nodes [rad/m]
  std::vector<double> weights;  // [wavenumber][node]: the value at a wavenumber is the sum of weights times values at the nodes
};

/// The wavenumbers of a sweep. One thread's: keeps the nodes it has computed.
class Band {
 public:
  explicit Band(std::span<const double> wavenumbers);

  std::span<const double> wavenumbers() const { return wavenumbers_; }

  /// Nodes for a function of k that is a sum of A e^{jkx}, all |x| <= half_span [m]. What they give differs from it by less than
  /// 1e-12 of the sum of |A|. Null where the wavenumbers are so few that nodes would not pay.
  const ChebyshevNodes* nodes(double half_span);
  /// Nodes for such a sum with amplitudes that change slowly with k: analytic but for k = 0, as roots and Fresnel integrals are.
  /// What they give differs by about `error` of the sum of |A|.
  const ChebyshevNodes* nodes_of_fresnel(double half_span, double error);
  /// The fewest nodes for such slow amplitudes to `error` of their sum, and over which half-span [m], not less than `least` over
  /// the wavenumber, waves may be added up before. No nodes where they would not pay.
  struct SlowNodes {
    const ChebyshevNodes* nodes = nullptr;
    double half_span = 0.0;
  };
  SlowNodes slow_nodes(double least, double error);

  double half_width() const { return half_width_; }  // of the wavenumbers [rad/m]

 private:
  const ChebyshevNodes* nodes_of_count(std::size_t count);

  std::vector<double> wavenumbers_;
  double middle_ = 0.0, half_width_ = 0.0;
  std::size_t most_ = 0;                         // nodes that pay
  double rate_ = 0.0;                            // ratio of successive Chebyshev coefficients of a function singular at k = 0
  std::map<std::size_t, ChebyshevNodes> nodes_;  // by their number
};

}  // namespace raytube
