// Which parts of an edge count in a look: those that the transmitter lights and, if so asked, the receiver sees, too.
#pragma once

#include <optional>

#include "utd/shadow/edge_visibility.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// Keeps references to wedges and tracer; `wavelength` [m] is the shortest of the look.
class LitEdges {
 public:
  /// Without `receiver` nothing but the transmitter casts shadows.
  LitEdges(std::span<const Wedge> wedges, const Tracer& tracer, const Viewpoint& transmitter,
           const std::optional<Viewpoint>& receiver, double wavelength);

  /// Looks for the lit parts of a wedge; false if there are none.
  bool find(std::uint32_t index, const WedgeIncidence& incidence);
  /// Those parts, in order, of the last wedge looked for.
  std::span<const LitInterval> lit() const { return lit_; }

 private:
  void keep_common();

  EdgeVisibility transmitter_;
  std::optional<EdgeVisibility> receiver_;  // none if nothing but the transmitter casts shadows, or if both are one
  std::vector<LitInterval> lit_, from_receiver_, common_;
};

}  // namespace raytube
