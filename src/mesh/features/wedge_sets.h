// The wedges of a target at every frequency of a sweep: which plates are thin and which details count depends on the wavelength.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesh/features/outlines.h"
#include "mesh/features/thin_plates.h"
#include "mesh/features/wedges.h"

namespace raytube {

/// What sets of wedges are made from; must outlive them.
struct WedgeSource {
  const TriangleMesh& mesh;                         // with these wedges
  const std::vector<Wedge>& wedges;                 // as the mesh has them
  const Outlines& outlines;                         // of their faces
  std::span<const ThinPlateEdge> thin_plate_edges;  // at frequencies where the plate is thin they become half planes
  double min_wedge_angle;                           // with which wedges and outlines were found [rad]
};

/// Wedges that some frequencies share.
struct WedgeSet {
  std::size_t thin_edges = 0;                          // so many of the thin-plate edges are half planes
  double detail_limit = 0.0;                           // finer details are not resolved [m]
  std::vector<std::size_t> indices{};                  // of these frequencies, in their list
  std::shared_ptr<const std::vector<Wedge>> wedges{};  // thin plates merged, details resolved
  std::shared_ptr<const Outlines> outlines{};          // of their faces

  /// Whether they are those of the mesh.
  bool as_given() const { return thin_edges == 0 && detail_limit == 0.0; }
};

/// The sets of all frequencies [Hz]; every frequency is in one. No set depends on which other frequencies there are.
std::vector<WedgeSet> wedge_sets(const WedgeSource& source, std::span<const double> frequencies);

/// That of a frequency, by its index.
const WedgeSet& set_of(std::span<const WedgeSet> sets, std::size_t frequency_index);

}  // namespace raytube
