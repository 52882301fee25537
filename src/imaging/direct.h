// Range profiles and images of pieces whose places are known, of one look at one frequency, without a sweep: image-domain
// ray-tube integration (Bhalla & Ling, IEEE Trans. AP-43 (1995), 783), summed here in the domain of wave vectors, where windows
// are.
//
//   S(K) = sum over pieces of S_i e^{j (K - K_0) . x_i} (|K| / |K_0|)^n
//
// K_0: wave vector of the look and the frequency; n = 1 for currents of physical optics on small pieces, 0 for edges. Valid as
// far as what is lit and the directions of what is reflected stay the same over the band and the angles.
#pragma once

#include <optional>

#include "imaging/isar.h"
#include "imaging/range_profile.h"

namespace raytube {

/// What a piece adds to S at the middle of a sweep.
struct PlacedScatterer {
  dvec3 place;         // [m]
  ScatteringMatrix s;  // [m]
  bool grows;          // in proportion to the frequency
};

/// The sample of an axis that pieces are computed at.
constexpr std::size_t middle_index(std::size_t count) { return count / 2; }

/// S of one look at all frequencies, from its pieces at the one of middle_index.
class DirectSweep {
 public:
  DirectSweep(const EvenAxis& frequency, const dvec3& direction);

  void add(const PlacedScatterer& piece);
  /// [frequency] [m]
  std::vector<ScatteringMatrix> scattering() const;

 private:
  EvenAxis frequency_;
  dvec3 direction_;
  std::array<GriddedSum, 2> sums_;  // [grows]
};

/// The image of a sweep, from the pieces of the look in the middle of its angles.
class DirectImage {
 public:
  DirectImage(const SweepSamples& sweep, const AngleGrid& grid);

  void add(const PlacedScatterer& piece);
  /// Throws InputError as isar_image does.
  IsarImage image(const IsarOptions& options, const std::string& what) const;

 private:
  const SweepSamples& sweep_;
  const AngleGrid& angles_;
  std::vector<dvec3> along_;        // unit: changes of K with frequency and the angles, in the order of the image's axes
  EvenGrid grid_;                   // of these changes [rad/m]
  double k_;                        // of the middle
  std::array<GriddedSum, 2> sums_;  // [grows]
};

}  // namespace raytube
