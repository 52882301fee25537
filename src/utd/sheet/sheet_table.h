// The sheets that stand for the plates of a target. Notation in sheet_admittance.h.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "mesh/features/wedges.h"
#include "utd/sheet/sheet_half_plane.h"

namespace raytube {

/// True for the border of a plate of one material that lets waves through, where nothing else is joined to it.
bool is_sheet_rim(const Wedge& wedge, std::span<const Material> materials);

/// At all frequencies of a sweep.
class SheetTable {
 public:
  SheetTable(std::span<const Material> materials, std::span<const double> frequencies);

  /// `frequency` [Hz] is one of the given ones.
  const SheetPair& at(std::uint32_t material, double frequency) const;

 private:
  std::vector<double> frequencies_;
  std::vector<std::vector<SheetPair>> pairs_;  // [material][frequency]; of others than sheets without currents
};

/// Half planes of them, made when they are first asked for.
class SheetHalfPlanes {
 public:
  /// Reaches within a factor of two share their tables.
  const SheetHalfPlane& at(const SheetPair& pair, bool electric, double sin_cone, double shortest);

  std::size_t made() const { return made_.size(); }

 private:
  std::map<std::tuple<const SheetAdmittance*, double, int>, std::unique_ptr<SheetHalfPlane>> made_;
};

}  // namespace raytube
