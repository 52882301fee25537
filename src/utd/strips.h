// Edge currents that end where their face ends, and the waves that go on from there. Derived in docs/edges.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "utd/panels.h"
#include "utd/strip_kernels.h"

namespace raytube {

/// What the strips of all edges radiate in one look: per frequency, the first strips and all that follow from them.
struct StripSums {
  std::vector<ScatteringMatrix> first;
  std::vector<ScatteringMatrix> higher;
  std::vector<bool> windowed;  // the forward-grazing window of endless strips touched the sum
};

/// Follows the fringe current of each edge point along its glancing ray over the face. Where the face ends at a convex wedge, the
/// current grazes that edge and diffracts there into both of its faces; `order` counts the strips one after another. A strip
/// that ends at a concave wedge ends there; one that reaches a smooth crease runs on for ever, as a first-order one.
class StripWalk {
 public:
  StripWalk(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look, std::span<const double> frequencies,
            int order, TransitionTier tier = TransitionTier::exact);

  /// The strips of wedge `index` from its lit pieces on, both faces.
  void add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit);

  StripSums take() { return std::move(sums_); }

 private:
  /// The points from which the strips of one step of a walk start. Amplitudes per transmit polarisation: weight, phase and eta H
  /// along the edge; frequency after frequency, point after point.
  struct Step {
    std::vector<dvec3> points;
    std::vector<std::uint32_t> panels;  // points of one panel leave at one edge
    std::array<std::vector<Complex>, 2> amplitudes;
    std::vector<double> lengths;
    std::vector<const OutlineEdge*> exits;
    std::vector<double> distinct;                  // lengths, of strips in a row that are alike one alone ...
    std::vector<std::size_t> kernel;               // ... and which of them a point has
    std::array<std::vector<Complex>, 2> arriving;  // at the far ends
  };
  /// S of one face for unit kernels, per receive polarisation.
  struct Projection {
    std::array<double, 2> across, along;
  };

  void start(const StripWave& wave, std::span<const LitInterval> lit);
  void place(const StripWave& wave, std::span<const LitInterval> lit);
  void follow(int level, const StripWave& wave);
  void find_ends(Step& step, const StripWave& wave) const;
  void find_kernels(const StripWave& wave, const Step& step);
  void bound_endless(const StripWave& wave, const Step& step);
  Projection projection(const StripWave& wave) const;
  void radiate_direct(const StripWave& wave);
  void radiate(const StripWave& wave, Step& step);
  void go_beyond(const StripWave& wave, std::span<const LitInterval> lit);
  void excite_far_edges(const StripWave& wave, double share);
  void pass_on(int level, const StripWave& wave);
  void gather(int level, std::size_t first, const dvec3& direction);
  void weigh(std::span<const Complex> amplitudes, const Step& step);
  Complex sum(const ComplexColumn& kernels, std::size_t frequency) const;

  std::span<const Wedge> wedges_;
  const Outlines& outlines_;
  const LookVectors& look_;
  std::vector<double> wavenumbers_;
  int order_;
  TransitionTier tier_;
  PanelPlacer placer_;
  std::vector<EdgePoint> points_;
  std::vector<Step> steps_;
  std::vector<double> lengths_;  // X of each kernel
  KernelBatch kernels_;
  std::vector<Complex> direct_;   // weight and phase of the points of the first strips
  std::vector<Complex> weights_;  // of each distinct length
  StripSums sums_;
};

}  // namespace raytube
