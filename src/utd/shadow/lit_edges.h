// Which parts of an edge count in a look: those that the transmitter sees and, if so asked, the receiver too.
#pragma once

#include <optional>

#include "utd/shadow/edge_visibility.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

class LitEdges {
 public:
  LitEdges(std::span<const Wedge> wedges, const Tracer& tracer, const LookVectors& look, double wavelength, bool receiver_shadow);
  LitEdges(std::span<const Wedge> wedges, const Tracer& tracer, const Viewpoint& transmitter,
           const std::optional<Viewpoint>& receiver, double wavelength);

  /// Looks for the lit parts of a wedge; false if there are none.
  bool find(std::uint32_t index, const WedgeIncidence& incidence);
  std::span<const LitInterval> lit() const { return lit_; }

 private:
  void keep_common();

  Visibility transmitter_;
  std::optional<Visibility> receiver_;  // none if nothing but the transmitter casts shadows, or if both are one
  std::vector<LitInterval> lit_, seen_, common_;
};

}  // namespace raytube
