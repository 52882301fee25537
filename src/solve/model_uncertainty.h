// What the asymptotic physics leaves out in the rows of a plan, estimated (uncertainty/omissions.h).
#pragma once

#include <string>
#include <vector>

#include "plan/plan.h"
#include "solve/look_result.h"
#include "uncertainty/facet_error.h"
#include "uncertainty/omissions.h"

namespace raytube {

/// What all looks share is found once. Refers to the plan. Thread-safe.
class ModelUncertainty {
 public:
  explicit ModelUncertainty(const SolvePlan& plan);

  /// [frequency] of a look that was computed; looks that follow from it have the same.
  std::vector<OmissionErrors> of(const Look& look, const LookResult& result) const;

  /// [frequency of the plan's band] all omissions together, of a look with tubes alone so far: as if all mechanisms that take
  /// part ran and added nothing, so no more than it will be.
  std::vector<ChannelErrors> at_least(const Look& look, std::size_t band, const TubeSums& tubes) const;

  const CurvedParts& curved_parts() const { return curved_; }  // what of the target is curved

  /// Of the weak edges at the first frequency, by length: the share beside curved faces.
  double curved_edges() const { return edges_.empty() ? 0.0 : curved_share(edges_[bands_.front().edges].edges); }

 private:
  // Frequencies that have their features of a look from one.
  struct Band {
    double frequency;   // [Hz]
    std::size_t edges;  // in edges_
    bool operator==(const Band&) const = default;
  };
  struct AtFrequency {
    std::size_t band, body;  // in bands_ and dents_
    PenumbraShares penumbras;
  };
  std::vector<LookFeatures> features(const Look& look) const;
  RowEvidence evidence(const Look& look, std::size_t frequency, const TubeSums& tubes, std::size_t at,
                       const std::vector<double>& met, const std::vector<ScatteringMatrix>& bounces) const;

  const SolvePlan& plan_;
  CurvedParts curved_;
  std::vector<EdgeFeatures> edges_;
  std::vector<Band> bands_;
  std::vector<AtFrequency> at_;    // [frequency]
  std::vector<FacetDents> dents_;  // of each band of the plan
  double rim_dent_;
};

}  // namespace raytube
