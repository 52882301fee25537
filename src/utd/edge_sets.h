// The edges of a target at every frequency of a sweep: which plates are thin depends on the wavelength.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "mesh/features/wedge_sets.h"
#include "mesh/model/face_tree.h"
#include "utd/corner/corner_waves.h"
#include "utd/fringe/corner_edges.h"
#include "utd/fringe/edges.h"
#include "utd/fringe/material_edges.h"
#include "utd/interaction/edge_face_interaction.h"
#include "utd/interaction/interaction_groups.h"

namespace raytube {

/// Sharp edges at some frequencies, and waves from corner to corner along them; null: at edge order 1.
struct WedgesAndCorners {
  WedgeSet wedges;
  std::shared_ptr<const CornerWaves> corners{};
};

/// The edges of a target and what is asked of them. What is referred to must outlive the EdgeSets made with it.
struct EdgeSetup {
  const Tracer& tracer;  // with the mesh
  const FaceTree& faces;
  std::vector<WedgesAndCorners> wedges;                               // at all of the frequencies
  std::span<const double> frequencies;                                // [Hz]
  bool interaction = false;                                           // whether edges illuminate other faces
  double interaction_work = std::numeric_limits<double>::infinity();  // that it may take in a look at one frequency (work.h)
  double least_reach = 0.0;               // of its plan of pairs, below which it is left out at a frequency
  std::span<const Material> materials{};  // of the mesh, at the frequencies; empty: perfect conductors alone
  bool material_edges = true;             // whether edges of materials count
  bool skip_enclosed = true;              // false: even edges that no light reaches are tested for light
  const CurvedTarget* curved = nullptr;   // if waves over curved surfaces count
  FringeOptions fringe{};                 // continue_by_images is set where edges illuminate other faces
};

/// Edges between perfect conductors, or beside other materials.
enum class EdgeKind { conductors, materials };

/// Waves over curved surfaces in one look.
struct WavesAtEdges {
  std::span<const SurfaceArrival> arrivals{};  // that reach edges, at the frequencies of the sets
  std::vector<bool> running{};  // [frequency] at which they run; at others strips of edges run straight. Empty: at none
};

/// How edge-face interaction of one look is computed.
struct InteractionLimits {
  double tolerance;                        // of its quadrature [m]
  const NearAntennas* antennas = nullptr;  // of InteractionOptions
};

/// Frequencies at which the same plates are thin share a set of edges; no set depends on the others.
class EdgeSets {
 public:
  explicit EdgeSets(const EdgeSetup& setup);
  EdgeSets(const EdgeSets&) = delete;

  /// Whether any edge does, in any look.
  bool radiate() const { return radiate(EdgeKind::conductors) || radiate(EdgeKind::materials); }
  bool radiate(EdgeKind kind) const;

  /// How long all edges that do are together, per frequency [m]. What a material blocks is 1 - T, at most twice what a conductor
  /// does: its edges count as two.
  std::vector<double> radiating_lengths() const;

  /// The fringe currents of one look at all frequencies, in their order; the lit wedges are counted at the highest. `radar` is
  /// that of antennas at a finite distance.
  EdgeLookResult scattering(const Look& look, const Radar& radar, const WavesAtEdges& waves, EdgeKind kind) const;

  /// The fringe currents of one look at one of the frequencies, piece by piece: see fringe_pieces().
  std::vector<ImageEdge> pieces(const Look& look, const Radar& radar, const PieceRequest& request, const WavesAtEdges& waves,
                                EdgeKind kind) const;

  /// Whether waves of this kind run along any edge from corner to corner.
  bool has_corner_waves(CornerWaveKind kind) const;
  /// What those of solids may add to |S| at each frequency [m] (solid_corner_amplitudes).
  std::vector<double> solid_corner_amplitudes(const Look& look, const Radar& radar) const;
  /// What they add to one look at all frequencies, and piece by piece at one of them.
  CornerWaveSum corner_waves(const Look& look, const Radar& radar, CornerWaveKind kind) const;
  std::vector<ImageEdge> corner_wave_pieces(const Look& look, const Radar& radar, const PieceRequest& request,
                                            CornerWaveKind kind) const;

  /// What waves over curved surfaces start at the edges, at one of the frequencies, wave by wave.
  std::vector<ImageEdge> arrival_pieces(const Look& look, const Radar& radar, const PieceRequest& request,
                                        std::span<const SurfaceArrival> arrivals) const;

  /// The strips over curved faces in one look, each at the first of the frequencies that it is computed for.
  std::vector<SurfaceRay> surface_rays(const Look& look, const Radar& radar, std::span<const SurfaceArrival> arrivals) const;

  /// Edge-face interaction of one look at all frequencies; zero at frequencies where it is not asked for, empty if there is none
  /// at any.
  InteractionResult interaction(const Look& look, const InteractionLimits& limits) const;

  /// Share of the squares expected of it that the work allowed reaches, [frequency]; none where there is none to be expected.
  const std::vector<std::optional<double>>& interaction_reach() const { return reach_; }

  /// Edge-face interaction of one look at one of the frequencies, by pieces of edges: see interaction_pieces().
  std::vector<ImageEdge> interaction_pieces(const Look& look, std::size_t frequency_index, const InteractionLimits& limits,
                                            bool by_path) const;

 private:
  struct Set {
    std::vector<std::size_t> indices;  // in the list of frequencies
    std::vector<double> frequencies;
    std::shared_ptr<const std::vector<Wedge>> wedges;
    std::shared_ptr<const Outlines> outlines;
    std::shared_ptr<const CornerWaves> corners;             // from order 2 on
    std::shared_ptr<const CurvedFaces> curved;              // from order 2 on, where waves over curved surfaces count
    std::vector<InteractionGroup> interaction;              // its indices are those of the set's frequencies
    InteractionParts parts;                                 // empty where there is no interaction
    std::vector<PairPlan> plans;                            // of each group
    bool continues = false;                                 // strips run on as images over right-angled corners
    std::vector<std::vector<std::size_t>> group_indices{};  // of each group, in the list of all frequencies

    // Only these of the frequencies.
    void keep(const std::vector<bool>& wanted);
  };
  bool radiates(const Wedge& wedge, EdgeKind kind) const;
  Set set_of(const WedgesAndCorners& edges) const;
  void prepare_interaction();
  void divide_by_mirrors();
  /// Frequencies of a set at which strips run over curved faces, or do not.
  struct SetPart {
    const Set& set;
    bool over_curved;
    std::vector<std::size_t> indices{};
    std::vector<double> frequencies{};
  };
  std::vector<SetPart> parts_of(const Set& set, const WavesAtEdges& waves) const;
  EdgeLook look_of(const Look& look, const Radar& radar, std::span<const double> frequencies) const;
  EdgeScene scene(const Set& set, bool over_curved) const;
  FringeOptions options(const Set& set, EdgeKind kind = EdgeKind::conductors) const;
  InteractionScene interaction_scene(const Set& set, const InteractionGroup& group) const;
  PairPlan plan_of(const InteractionParts& parts, const InteractionGroup& group) const;
  void put(const Set& set, const InteractionGroup& group, const InteractionResult& part, InteractionResult& all) const;
  static void put(const std::vector<std::size_t>& indices, const EdgeLookResult& part, EdgeLookResult& all);

  EdgeSetup setup_;
  std::vector<Set> sets_;                     // highest frequency first
  std::vector<std::optional<double>> reach_;  // [frequency] of edge-face interaction; none where there is none
  std::optional<OpaqueAndScreens> screens_;
  std::optional<EdgeMaterials> materials_;  // if edges of materials count
};

}  // namespace raytube
