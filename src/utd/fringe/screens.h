// Screens: sheets that let waves through, before the transmitter, the receiver or both.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/trace/tracer.h"
#include "scene/material.h"
#include "utd/shadow/edge_visibility.h"

namespace raytube {

/// The opaque surfaces of a target and its screens, each as if the others were not there. `materials` must outlive it.
class OpaqueAndScreens {
 public:
  OpaqueAndScreens(const TriangleMesh& mesh, std::span<const Material> materials);
  OpaqueAndScreens(const OpaqueAndScreens&) = delete;

  const Tracer& opaque() const { return opaque_; }

  /// The patches of the screens that stand between a point and the antenna in this direction, nearest first; `own` is the screen
  /// that the point is on.
  std::vector<std::uint32_t> before(const dvec3& point, const dvec3& direction, std::uint32_t own = no_index) const;
  const dvec3& normal(std::uint32_t patch) const { return screen_mesh_.patches[patch].normal; }
  const Material& material(std::uint32_t patch) const { return materials_[screen_mesh_.patches[patch].material]; }

 private:
  TriangleMesh opaque_mesh_, screen_mesh_;
  Tracer opaque_, screens_;
  std::span<const Material> materials_;
};

/// Some of the frequencies of a sweep.
struct SweepSubset {
  std::span<const double> frequencies;     // [Hz]
  std::span<const std::size_t> indices{};  // of each in the sweep, as materials are tabulated; used with screens only
};

/// One of the frequencies of a sweep.
struct SweepFrequency {
  std::size_t index;  // in the sweep
  double wavenumber;

  SweepFrequency(const SweepSubset& subset, std::size_t i)
      : index(subset.indices[i]), wavenumber(raytube::wavenumber(subset.frequencies[i])) {}
};

/// The patches of the screens before the transmitter and before the receiver.
using Screens = std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>;

/// A part of an edge that has the same screens all over.
struct ScreenedInterval {
  LitInterval lit;
  Screens screens;
};

/// Cuts lit parts of edges where they change their screens: found to within 1e-9 of their length; screens that cover less than
/// the spacing of the points at which EdgeVisibility tests may be missed.
class ScreenCutter {
 public:
  /// Without `receiver` it stands where the transmitter does. `wavelength` [m] is the shortest of the look.
  ScreenCutter(const OpaqueAndScreens& target, const Viewpoint& transmitter, const std::optional<Viewpoint>& receiver,
               double wavelength)
      : target_(target), transmitter_(transmitter), receiver_(receiver), wavelength_(wavelength) {}

  /// Appends the parts of `lit`, in order.
  void cut(const Wedge& wedge, const LitInterval& lit, std::vector<ScreenedInterval>& parts) const;

 private:
  Screens at(const Wedge& wedge, double fraction) const;
  double bisect(const Wedge& wedge, const Screens& screens, double low, double high) const;

  const OpaqueAndScreens& target_;
  Viewpoint transmitter_;
  std::optional<Viewpoint> receiver_;
  double wavelength_;
};

/// What comes through screens at one frequency, from and to antennas in the directions of these bases.
class Passage {
 public:
  Passage(const OpaqueAndScreens& target, const Screens& screens, const SweepFrequency& at, const SphericalBasis& transmit,
          const SphericalBasis& receive);

  /// S of something without screens becomes that behind them.
  void transform(ScatteringMatrix& s) const;

 private:
  ChannelWeights transmit_, receive_;
};

}  // namespace raytube
