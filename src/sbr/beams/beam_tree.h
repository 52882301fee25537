// All beams of a tile: tubes that met the same patches in the same order share one beam and one footprint.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <vector>

#include "sbr/beams/footprint.h"
#include "sbr/beams/surfaces_met.h"

namespace raytube {

class BeamTree {
 public:
  static constexpr std::uint32_t root = 0;

  BeamTree(const TriangleMesh& mesh, const SpectralSurfaces& surfaces, const SphericalBasis& receive, const Beam& incident)
      : mesh_(mesh), surfaces_(surfaces), receive_(receive) {
    restart(incident);
  }

  /// Forgets all beams but keeps their memory.
  void restart(const Beam& incident);

  /// The footprint of beam `parent` on `patch`, computed on first use, with the anchor then given. Of a spherical wave only the
  /// beam that leaves: its footprint differs from tube to tube.
  std::uint32_t child(std::uint32_t parent, std::uint32_t patch, const dvec2& anchor) {
    const Node& node = at(parent);
    return node.recent_patch == patch ? node.recent_child : find_child(parent, patch, anchor);
  }

  const SpectralSurfaces& surfaces() const { return surfaces_; }
  /// False if all beams so far have met perfect conductors only.
  bool spectral() const { return spectral_; }
  /// Beams from before the last bounce will not be asked for again, and are forgotten.
  void next_bounce();
  /// The beam that goes on behind the surface that this one was reflected by; no_index if there is none.
  std::uint32_t through(std::uint32_t node) const { return at(node).through; }
  /// Amplitude of a beam for unit incident waves, at the frequency where it is largest.
  double amplitude(std::uint32_t node) const { return at(node).amplitude; }
  /// False if so little of a wave is left that it ends.
  bool is_lit(std::uint32_t node) const { return at(node).amplitude > least_amplitude; }

  bool is_sheet(std::uint32_t patch) const { return surfaces_.transmits(mesh_.patches[patch].material); }
  /// A node for the currents of a footprint, or of what through_screen() made of one, once more: as the receiver has them through
  /// a sheet which stands before it, less as it would have them without. Only what is radiated back counts: the wave's shadow is
  /// a part of the incident wave, and no sheet stands before that.
  std::uint32_t through_screen(std::uint32_t node, std::uint32_t sheet);

  bool is_screened(std::uint32_t node) const { return at(node).unscreened != no_index; }
  /// What that node's sheet adds, as a factor of the S that a footprint's returning wave has without sheets.
  ChannelWeights added_by_screen(std::uint32_t node, std::size_t frequency_index) const;

  /// Whether a beam has been reflected; false of the incident wave, behind sheets too.
  bool is_reflected(std::uint32_t node) const;

  const Footprint& footprint(std::uint32_t node) const { return at(node).footprint; }
  const Beam& beam(std::uint32_t node) const { return at(node).footprint.outgoing; }
  /// The patch of this beam's footprint, which it leaves.
  std::uint32_t patch_index(std::uint32_t node) const { return at(node).patch; }
  const Patch& patch(std::uint32_t node) const { return mesh_.patches[at(node).patch]; }
  /// True if the patch of this beam's footprint is lit from the side its normal points away from.
  bool from_behind(std::uint32_t node) const { return at(node).from_behind; }

 private:
  struct Node {
    Footprint footprint;
    std::uint32_t patch = no_index;
    std::uint32_t recent_patch = no_index, recent_child = no_index;  // neighbouring tubes mostly ask for the same child
    std::uint32_t through = no_index;
    std::uint32_t unscreened = no_index;  // of currents received through a sheet: the node they are without it
    std::uint32_t screen = no_index;      // and the sheet
    double amplitude = 1.0;
    bool from_behind = false;
    bool reflected = false;  // the wave that arrives has been, somewhere before
    bool goes_on = false;    // the beam is the wave that arrives, behind a sheet
  };
  struct Slot {
    std::uint32_t parent = no_index, patch = no_index, child = no_index;
  };

  Node& at(std::uint32_t node) { return nodes_[node - first_]; }
  const Node& at(std::uint32_t node) const { return nodes_[node - first_]; }
  std::uint32_t end() const { return first_ + static_cast<std::uint32_t>(nodes_.size()); }
  const Spectrum* keep(Spectrum spectrum);
  const SurfacesMet* keep(SurfacesMet met);
  std::uint32_t find_child(std::uint32_t parent, std::uint32_t patch, const dvec2& anchor);
  std::uint32_t add_child(std::uint32_t parent, std::uint32_t patch, const dvec2& anchor);
  std::uint32_t add_screened(std::uint32_t node, std::uint32_t sheet);
  const std::vector<ChannelWeights>& through_sheet(std::uint32_t sheet);
  ChannelWeights screened_weights(const Node& node, std::size_t frequency_index) const;
  ChannelWeights through_screens(std::uint32_t node, std::size_t frequency_index) const;
  void scatter(std::uint32_t parent, Node& node);
  void scatter_spherical(std::uint32_t parent, Node& node);
  void add_through(std::uint32_t parent, Node& node, Spectrum transmitted);
  void add_through(Node& node, const Beam& passing, double amplitude);
  SurfacesMet screened_surfaces(const Node& node, std::uint32_t sheet) const;
  Spectrum screened_spectrum(const Node& node, std::uint32_t sheet);
  Slot& slot(std::uint32_t parent, std::uint32_t patch);
  void widen();

  const TriangleMesh& mesh_;
  SpectralSurfaces surfaces_;
  SphericalBasis receive_;
  std::vector<Node> nodes_;  // from number first_ on
  std::uint32_t first_ = 0, first_of_bounce_ = 0;
  std::deque<Spectrum> spectra_, earlier_spectra_;                       // beams hold pointers to them
  std::deque<SurfacesMet> met_, earlier_met_;                            // and to these
  std::map<std::uint32_t, std::vector<ChannelWeights>> through_sheets_;  // [patch][frequency]
  bool spectral_ = false;
  std::vector<Slot> slots_;  // hash table with linear probing; a power of two of them, at most half in use
};

}  // namespace raytube
