#include "utd/shadow/lit_edges.h"

#include <algorithm>
#include <utility>

namespace raytube {

LitEdges::LitEdges(std::span<const Wedge> wedges, const Tracer& tracer, const Viewpoint& transmitter,
                   const std::optional<Viewpoint>& receiver, double wavelength)
    : transmitter_(wedges, tracer, transmitter, wavelength) {
  if (receiver) receiver_.emplace(wedges, tracer, *receiver, wavelength);
}

bool LitEdges::find(std::uint32_t index, const WedgeIncidence& incidence) {
  transmitter_.find(index, incidence.free_side, lit_);
  if (receiver_ && !lit_.empty()) {
    receiver_->find(index, dvec3(0.0), from_receiver_);
    keep_common();
  }
  return !lit_.empty();
}

// Both lists are in order; so is what they share.
void LitEdges::keep_common() {
  common_.clear();
  for (const LitInterval& lit : lit_)
    for (const LitInterval& other : from_receiver_) {
      const double begin = std::max(lit.begin, other.begin), end = std::min(lit.end, other.end);
      if (begin < end) common_.push_back({begin, end});
    }
  std::swap(lit_, common_);
}

}  // namespace raytube
