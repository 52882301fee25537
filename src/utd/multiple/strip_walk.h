// Edge currents that end where their face ends, and the waves that go on from there. Derived in docs/edges.md.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

#include "math/chebyshev.h"
#include "utd/multiple/panels.h"
#include "utd/multiple/strip_kernels.h"
#include "utd/multiple/thin_edge.h"

namespace raytube {

/// What the strips of all edges radiate in one look: per frequency, the first strips and all that follow from them.
struct StripSums {
  std::vector<ScatteringMatrix> first;
  std::vector<ScatteringMatrix> higher;
  std::vector<bool> windowed;  // the forward-grazing window of endless strips touched the sum
};

/// Follows the fringe current of each edge point along its glancing ray over the face. Where the face ends at a convex wedge, the
/// current grazes that edge and diffracts there into both of its faces; `order` counts the strips one after another. A strip
/// that ends at a concave wedge ends there or, with `continue_by_images`, runs on mirrored if the angle is a right one; one that
/// reaches a smooth crease runs on for ever, as a first-order one.
class StripWalk {
 public:
  StripWalk(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look, std::span<const double> frequencies,
            int order, TransitionTier tier = TransitionTier::exact, bool continue_by_images = false);

  /// The strips of wedge `index` from its lit pieces on, both faces.
  void add(std::uint32_t index, const WedgeIncidence& incidence, std::span<const LitInterval> lit);

  StripSums take() { return std::move(sums_); }

 private:
  /// S of one face for unit kernels, per receive polarisation.
  struct Projection {
    std::array<double, 2> across, along;
  };
  /// What all frequencies share of a wave.
  struct Face {
    Strip strip;
    std::optional<ThinEdge> thin;  // if it is the edge of a thin sheet
    Projection seen;
  };
  /// Where a bundle's amplitudes are at its start and at its end, and its kernels at the first wavenumber of a block: one for
  /// each point, or one for all where its strips are alike.
  struct Row {
    std::size_t amplitude, arriving, kernel, size;
    bool alike;
  };

  /// Frequencies whose kernels are found together, so that lanes are full where a wave has a kernel or two.
  static constexpr std::size_t block = lanes;
  /// What a tree adds: its first strips, and the share of those that follow them.
  struct Part {
    bool first;
    double higher;
  };

  /// Of a wave at the wavenumbers of a block.
  struct Kernels {
    KernelBatch batch;
    std::size_t stride = 0;  // from one wavenumber to the next
  };
  /// Bounds of the exponents over k of what a wave radiates [m].
  struct PathRange {
    double low, high;
    double middle() const { return 0.5 * (low + high); }
    double half() const { return 0.5 * (high - low); }
    void include(std::initializer_list<double> paths) {
      low = std::min(low, std::min(paths));
      high = std::max(high, std::max(paths));
    }
  };

  void start(const StripWave& wave, std::span<const LitInterval> lit);
  void grow(const StripWave& wave, std::span<const LitInterval> lit);
  void start_beside(const StripWave& wave, std::span<const LitInterval> lit);
  void add_tree(const Part& part);
  void interpolate(const ChebyshevNodes& nodes, const Part& part);
  void add_samples(const ChebyshevNodes& nodes, std::size_t wave, std::vector<ScatteringMatrix>& sums) const;
  template <class SumOf>
  void radiate_at(std::span<const double> wavenumbers, const Part& part, SumOf sum_of);
  void find_paths();
  Projection projection(const StripWave& wave) const;
  void lay_out_rows();
  std::span<const Row> rows(const TreeWave& wave) const;
  void find_phases(double wavenumber);
  void find_lengths(std::size_t wave, std::span<const double> wavenumbers);
  void find_kernels(std::size_t wave, std::span<const double> wavenumbers);
  double tip() const;
  void fade_soft_ends(KernelBatch& batch);
  void keep_mirrored_part(std::size_t wave, std::span<const double> wavenumbers);
  void count_thickness(std::size_t wave, std::span<const double> wavenumbers, std::span<const double> lengths,
                       KernelBatch& batch);
  bool is_semi_infinite(const TreeWave& wave) const;
  SplitKernels split_untruncated() const;
  void bound_untruncated(std::span<const double> wavenumbers);
  void note_windows();
  Complex radiated_direct(std::size_t wave, const ComplexColumn& kernels, std::size_t place) const;
  PairSums radiated(std::size_t wave, std::size_t place) const;
  void radiate_direct(std::size_t wave, std::size_t place, double share, ScatteringMatrix& sum) const;
  void radiate(std::size_t wave, std::size_t place, ScatteringMatrix& sum) const;
  void radiate_higher(std::size_t wave, std::size_t place, double share, ScatteringMatrix& sum);
  void excite_far_edges(std::size_t wave, std::size_t place, double share);
  void pass_on(std::size_t wave, std::size_t place);

  std::span<const Wedge> wedges_;
  const LookVectors& look_;
  Band band_;
  int order_;
  TransitionTier tier_;
  WaveTree tree_;
  double tip_ = 0.0;  // electrical length of strips that pass no soft current on
  PanelPlacer placer_;
  std::vector<Face> faces_;                // of each wave of the tree
  std::vector<Row> rows_;                  // of each bundle
  ComplexColumn direct_;                   // weight and phase of the first strips
  std::array<ComplexColumn, 2> arriving_;  // per transmit polarisation, at the ends: weight, phase and eta H along the edge
  std::vector<double> lengths_;            // X of each kernel of a wave
  std::vector<double> behind_, detours_;   // of each kernel of a mirrored wave: X at its start; phase of the image of its source
  KernelBatch shorter_;
  std::vector<Kernels> kernels_;             // of each wave
  std::vector<PathRange> paths_;             // of each wave
  std::vector<double> from_ends_, to_ends_;  // exponents over k where the strips from both sides of each bundle end [m]
  std::vector<std::vector<ScatteringMatrix>> samples_;  // of each wave at the nodes
  StripSums sums_;
};

}  // namespace raytube
