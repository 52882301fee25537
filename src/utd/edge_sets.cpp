#include "utd/edge_sets.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace raytube {

namespace {

EdgeLookResult edges_of_look(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer, const Look& look,
                             std::span<const double> frequencies, int order, bool receiver_shadow, TransitionTier tier,
                             bool continue_by_images, const Radar& radar, const dvec3& center) {
  if (!look.far())
    return fringe_scattering_near(wedges, outlines, tracer, AntennaPair(look, radar, center), frequencies, order, receiver_shadow,
                                  tier, continue_by_images);
  if (order == 1) return fringe_scattering(wedges, tracer, look, frequencies, receiver_shadow);
  return fringe_scattering(wedges, outlines, tracer, look, frequencies, order, receiver_shadow, tier, continue_by_images);
}

}  // namespace

EdgeSets::EdgeSets(const TriangleMesh& mesh, const std::vector<Wedge>& wedges, const Outlines& outlines,
                   std::span<const ThinPlateEdge> rims, double min_wedge_angle, std::span<const double> frequencies,
                   bool skip_enclosed)
    : frequency_count_(frequencies.size()) {
  for (std::size_t place = 0; place < frequencies.size(); ++place) {
    const std::size_t thin = count_thin(rims, frequencies[place]);
    auto set = std::ranges::find(sets_, thin, &Set::thin_rims);
    if (set == sets_.end()) set = sets_.insert(sets_.end(), {thin, {}, {}, {}, {}, {}});
    set->places.push_back(place);
    set->frequencies.push_back(frequencies[place]);
  }
  std::ranges::sort(sets_, {}, &Set::thin_rims);
  for (Set& set : sets_) {
    const bool sharp = set.thin_rims == 0;
    set.wedges = sharp ? wedges : merge_thin_plate_edges(wedges, rims, thin_limit(set.frequencies.front()));
    set.outlines = sharp ? outlines : Outlines(mesh, set.wedges, min_wedge_angle);
    if (skip_enclosed) continue;
    for (Wedge& wedge : set.wedges) wedge.enclosed = false;
  }
}

bool EdgeSets::radiate() const {
  const auto one_does = [](const Wedge& wedge) { return wedge.radiates(); };
  return std::ranges::any_of(sets_, [&](const Set& set) { return std::ranges::any_of(set.wedges, one_does); });
}

EdgeLookResult EdgeSets::scattering(const Tracer& tracer, const Look& look, int order, bool receiver_shadow, TransitionTier tier,
                                    const Radar& radar) const {
  const auto part = [&](const Set& set) {
    if (sheets_)
      return screened_fringe_scattering(set.wedges, set.outlines, *sheets_, look, set.frequencies, set.places, order,
                                        receiver_shadow, tier);
    return edges_of_look(set.wedges, set.outlines, tracer, look, set.frequencies, order, receiver_shadow, tier,
                         !set.interaction.empty(), radar, tracer.mesh().center);
  };
  if (sets_.size() == 1) return part(sets_.front());
  EdgeLookResult all;
  all.scattering.resize(frequency_count_);
  if (order > 1) all.higher.resize(frequency_count_);
  all.windowed.resize(frequency_count_);
  for (const Set& set : sets_) put(set, part(set), all);
  return all;
}

std::vector<ImageEdge> EdgeSets::pieces(const Tracer& tracer, const Look& look, std::size_t frequency, int order,
                                        bool receiver_shadow, TransitionTier tier, const ImageLattice& lattice) const {
  for (const Set& set : sets_) {
    const auto place = std::ranges::find(set.places, frequency);
    if (place == set.places.end()) continue;
    const auto index = static_cast<std::size_t>(place - set.places.begin());
    if (sheets_)
      return screened_fringe_pieces(set.wedges, set.outlines, *sheets_, look, set.frequencies, index, frequency, order,
                                    receiver_shadow, tier, lattice);
    return fringe_pieces(set.wedges, set.outlines, tracer, look, set.frequencies, index, order, receiver_shadow, tier,
                         !set.interaction.empty(), lattice);
  }
  return {};
}

std::vector<ImageEdge> EdgeSets::interaction_pieces(const FaceTree& tree, const Tracer& tracer, const Look& look,
                                                    std::size_t frequency, const InteractionOptions& options) const {
  for (const Set& set : sets_)
    for (const InteractionGroup& group : set.interaction)
      for (std::size_t i = 0; i < group.places.size(); ++i) {
        if (set.places[group.places[i]] != frequency) continue;
        const InteractionScene scene{tree, tracer, set.wedges, set.outlines, group.axes, group.corners, group.large};
        return raytube::interaction_pieces(scene, look, group.frequencies, i, options);
      }
  return {};
}

void EdgeSets::Set::keep(const std::vector<bool>& wanted) {
  const std::vector<std::size_t> all_places = std::exchange(places, {});
  const std::vector<double> all_frequencies = std::exchange(frequencies, {});
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    places.push_back(all_places[i]);
    frequencies.push_back(all_frequencies[i]);
  }
}

// Currents run on over folds where what comes from there is painted, and only there: such frequencies are a set of their own.
void EdgeSets::prepare_interaction(const TriangleMesh& mesh, const std::vector<bool>& above_limit) {
  std::vector<Set> without;
  for (Set& set : sets_) {
    std::vector<bool> above_limit_here, painted(set.places.size());
    for (const std::size_t place : set.places) above_limit_here.push_back(above_limit[place]);
    for (const InteractionGroup& group : interaction_groups(mesh, set.wedges, set.frequencies, above_limit_here))
      for (const std::size_t place : group.places) painted[place] = true;
    if (std::ranges::find(painted, true) == painted.end()) continue;
    if (std::ranges::find(painted, false) != painted.end()) {
      without.push_back(set);
      set.keep(painted);
      painted.flip();
      without.back().keep(painted);
    }
    set.interaction = interaction_groups(mesh, set.wedges, set.frequencies, std::vector<bool>(set.places.size()));
  }
  std::ranges::move(without, std::back_inserter(sets_));
  std::ranges::sort(sets_, std::ranges::greater{}, [](const Set& set) { return std::ranges::max(set.frequencies); });
}

InteractionResult EdgeSets::interaction(const FaceTree& tree, const Tracer& tracer, const Look& look,
                                        const InteractionOptions& options) const {
  InteractionResult all;
  for (const Set& set : sets_)
    for (const InteractionGroup& group : set.interaction) {
      const InteractionScene scene{tree, tracer, set.wedges, set.outlines, group.axes, group.corners, group.large};
      const InteractionResult part = interaction_scattering(scene, look, group.frequencies, options);
      if (part.scattering.empty()) continue;
      all.scattering.resize(frequency_count_);
      all.error.resize(frequency_count_);
      all.lit_pieces = std::max(all.lit_pieces, part.lit_pieces);
      for (std::size_t i = 0; i < group.places.size(); ++i) {
        all.scattering[set.places[group.places[i]]] = part.scattering[i];
        all.error[set.places[group.places[i]]] = part.error[i];
      }
    }
  return all;
}

void EdgeSets::put(const Set& set, const EdgeLookResult& part, EdgeLookResult& all) {
  all.lit = all.lit || part.lit;
  if (all.wedges_lit == 0) all.wedges_lit = part.wedges_lit;
  for (std::size_t i = 0; i < set.places.size(); ++i) {
    all.scattering[set.places[i]] = part.scattering[i];
    all.windowed[set.places[i]] = part.windowed[i];
    if (!part.higher.empty()) all.higher[set.places[i]] = part.higher[i];
  }
}

}  // namespace raytube
