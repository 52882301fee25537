// The edges of a target at every frequency of a sweep: which rims are thin depends on the wavelength.
#pragma once

#include <optional>

#include "mesh/features/thin_plates.h"
#include "utd/fringe/edges.h"
#include "utd/fringe/screened_edges.h"
#include "utd/interaction/edge_face_interaction.h"
#include "utd/interaction/interaction_groups.h"

namespace raytube {

class EdgeSets {
 public:
  /// `wedges` and `outlines` are those of sharp edges; rims thin at a frequency become half planes there. Frequencies that see
  /// the same rims as thin share a set, and no set depends on the others.
  /// Without `skip_enclosed` even edges that no light reaches are asked whether they are lit.
  EdgeSets(const TriangleMesh& mesh, const std::vector<Wedge>& wedges, const Outlines& outlines,
           std::span<const ThinPlateEdge> rims, double min_wedge_angle, std::span<const double> frequencies, bool skip_enclosed);
  EdgeSets(const EdgeSets&) = delete;

  /// From now on edges behind sheets of these materials count, too. Both arguments are kept by reference.
  void look_through_sheets(const TriangleMesh& mesh, std::span<const Material> materials) { sheets_.emplace(mesh, materials); }

  /// Whether any edge does, in any look.
  bool radiate() const;

  /// One look at all frequencies, in their order; the lit wedges are counted at the highest.
  EdgeLookResult scattering(const Tracer& tracer, const Look& look, int order, bool receiver_shadow, TransitionTier tier,
                            const Radar& radar) const;

  /// The same at one of the frequencies, piece by piece: see fringe_pieces.
  std::vector<ImageEdge> pieces(const Tracer& tracer, const Look& look, std::size_t frequency, int order, bool receiver_shadow,
                                TransitionTier tier, const ImageLattice& lattice) const;

  /// Finds the edges that may light other surfaces than their own, at the frequencies that are not `crowded`.
  void prepare_interaction(const TriangleMesh& mesh, const std::vector<bool>& above_limit);

  /// What the waves of edges do on other surfaces in one look at all frequencies; nothing unless prepared.
  InteractionResult interaction(const FaceTree& tree, const Tracer& tracer, const Look& look,
                                const InteractionOptions& options) const;
  /// The same at one of the frequencies, by the lit pieces of edges these waves come from.
  std::vector<ImageEdge> interaction_pieces(const FaceTree& tree, const Tracer& tracer, const Look& look, std::size_t frequency,
                                            const InteractionOptions& options) const;

 private:
  struct Set {
    std::size_t thin_rims = 0;
    std::vector<std::size_t> places;  // in the list of frequencies
    std::vector<double> frequencies;
    std::vector<Wedge> wedges;
    Outlines outlines;
    std::vector<InteractionGroup> interaction;  // its places are those of the set's frequencies

    // Only these of the frequencies.
    void keep(const std::vector<bool>& wanted);
  };
  static void put(const Set& set, const EdgeLookResult& part, EdgeLookResult& all);

  std::vector<Set> sets_;  // highest frequency first
  std::size_t frequency_count_;
  std::optional<OpaqueAndScreens> sheets_;
};

}  // namespace raytube
