// Waves that the rim of a plate sends over it to its other rims. Notation in sheet_admittance.h.
//
// What a half plane's current has beyond physical optics is a sum of waves e^{-jk v x}: those that the plate guides, and points
// of a branch cut. They follow the grazing diffracted ray, as strips of conductors do (Michaeli 1986), each with its own phase:
// exact where rims are parallel. A wave that arrives at a rim makes a half plane's current there, which takes the place of what
// it would have beyond, and sends waves in turn.
#pragma once

#include "utd/multiple/edge_panels.h"
#include "utd/sheet/rim_look.h"
#include "utd/sheet/sheet_table.h"

namespace raytube {

/// What sums over sheet rims are made from; referred to.
struct SheetScene {
  std::span<const Wedge> wedges;
  const Outlines& outlines;
  std::span<const Material> materials;
  const SheetTable& table;
};

/// The strips of one rim after the other. Keeps references to its arguments.
class SheetStrips {
 public:
  SheetStrips(const SheetScene& scene, const LookVectors& look, double shortest_wavelength, SheetHalfPlanes& half_planes);

  /// Those that start on the lit pieces of rim `index` and pass `order` rims.
  void lay(std::uint32_t index, const FaceIncidence& incidence, std::span<const LitInterval> lit, int order);

  /// Adds S [m] of what they make at other rims; c of the wave at their own.
  void add(const RimLook& rim, double c, const SheetPair& pair, double wavenumber, ScatteringMatrix& sum);

  /// Electrical length of the shortest of them.
  double shortest(double wavenumber) const { return wavenumber * shortest_; }

  double work() const { return work_; }

 private:
  struct Sheet;
  struct Departure;
  struct ArrivedWave;
  void follow(const Sheet& sheet, const Departure& from, ScatteringMatrix& sum);
  void arrive(const Sheet& sheet, const Departure& from, std::uint32_t bundle, std::uint32_t next, ScatteringMatrix& sum);
  std::vector<Received> of_unit_waves(const Sheet& sheet, const RimLook& from, const RimLook& rim,
                                      std::span<const ArrivedWave> waves, const SheetHalfPlane& here) const;
  void radiate(const Sheet& sheet, const RimLook& from, const RimLook& rim, std::span<const ArrivedWave> waves,
               const Departure& arriving, std::uint32_t bundle, double sines, ScatteringMatrix& sum) const;

  SheetScene scene_;
  const LookVectors& look_;
  SheetHalfPlanes& half_planes_;
  WaveTree tree_;
  EdgePanels panels_;
  double shortest_ = 0.0;  // least mean length of a bundle's strips in the tree, times sin_cone^2 [m]
  double work_ = 0.0;
};

}  // namespace raytube
