#include "sbr/beams/beam_tree.h"

#include <algorithm>

namespace raytube {

void BeamTree::restart(const Beam& incident) {
  nodes_.clear();
  first_ = first_of_bounce_ = 0;
  spectra_.clear();
  earlier_spectra_.clear();
  met_.clear();
  earlier_met_.clear();
  spectral_ = false;
  nodes_.push_back({{incident, {}}});
  if (slots_.empty()) slots_.resize(64);
  std::ranges::fill(slots_, Slot{});
}

void BeamTree::next_bounce() {
  nodes_.erase(nodes_.begin(), nodes_.begin() + (first_of_bounce_ - first_));
  first_ = first_of_bounce_;
  first_of_bounce_ = end();
  earlier_spectra_.swap(spectra_);
  spectra_.clear();
  earlier_met_.swap(met_);
  met_.clear();
  std::ranges::fill(slots_, Slot{});
}

std::uint32_t BeamTree::find_child(std::uint32_t parent, std::uint32_t patch, const dvec2& anchor) {
  Slot& taken = slot(parent, patch);
  if (taken.child == no_index) taken = {parent, patch, add_child(parent, patch, anchor)};
  const std::uint32_t child = taken.child;
  at(parent).recent_patch = patch;
  at(parent).recent_child = child;
  if (2 * nodes_.size() > slots_.size()) widen();
  return child;
}

std::uint32_t BeamTree::add_child(std::uint32_t parent, std::uint32_t patch, const dvec2& anchor) {
  const Beam& beam = this->beam(parent);
  const Patch& plane = mesh_.patches[patch];
  const bool from_behind = facing(beam, plane) > 0.0;
  const Footprint footprint = beam.spherical() ? Footprint{reflected_spherical(beam, plane), {}}
                                               : raytube::footprint(anchored(beam, anchor), plane, receive_);
  Node node{footprint, patch};
  node.from_behind = from_behind, node.reflected = is_reflected(parent);
  if (plane.material != no_index || beam.spectrum || beam.met)
    beam.spherical() ? scatter_spherical(parent, node) : scatter(parent, node);
  nodes_.push_back(node);
  return end() - 1;
}

// Fields and weights where perfect conductors are not all that the wave has met.
void BeamTree::scatter(std::uint32_t parent, Node& node) {
  LeavingWaves waves = leaving_waves(surfaces_, beam(parent), node.reflected, mesh_.patches[node.patch], receive_);
  node.amplitude = raytube::amplitude(waves.reflected);
  node.footprint.outgoing.spectrum = keep(std::move(waves.reflected));
  if (raytube::amplitude(waves.transmitted) > least_amplitude) add_through(parent, node, std::move(waves.transmitted));
}

// What the wave is at a point is found there; here only what it has met, and the most that is left of it.
void BeamTree::scatter_spherical(std::uint32_t parent, Node& node) {
  Beam passing = beam(parent);
  const Patch& plane = mesh_.patches[node.patch];
  const auto [reflected, transmitted] = strongest(surfaces_, passing, plane, mesh_.radius);
  SurfacesMet met = with_surface(passing, {plane.normal, plane.material}, node.reflected);
  node.amplitude = amplitude(parent) * reflected;
  node.footprint.outgoing.met = keep(met);
  if (amplitude(parent) * transmitted <= least_amplitude) return;
  met.surfaces.back().goes_on = true;
  passing.met = keep(std::move(met));
  add_through(node, passing, amplitude(parent) * transmitted);
}

const Spectrum* BeamTree::keep(Spectrum spectrum) {
  spectral_ = true;
  return &spectra_.emplace_back(std::move(spectrum));
}

const SurfacesMet* BeamTree::keep(SurfacesMet met) {
  spectral_ = true;
  return &met_.emplace_back(std::move(met));
}

// The arriving wave as it was but for its fields, described from where it meets the surface.
void BeamTree::add_through(std::uint32_t parent, Node& node, Spectrum transmitted) {
  const Beam& leaving = node.footprint.outgoing;
  Beam passing = beam(parent);
  passing.anchor = leaving.anchor, passing.base = leaving.base;
  passing.along_u = leaving.along_u, passing.along_v = leaving.along_v;
  const double amplitude = raytube::amplitude(transmitted);
  passing.spectrum = keep(std::move(transmitted));
  add_through(node, passing, amplitude);
}

void BeamTree::add_through(Node& node, const Beam& passing, double amplitude) {
  Node through{{passing, {}}, node.patch};
  through.reflected = node.reflected, through.goes_on = true;
  through.amplitude = amplitude;
  node.through = end();
  nodes_.push_back(through);
}

bool BeamTree::is_reflected(std::uint32_t node) const {
  const Node& n = at(node);
  return n.goes_on ? n.reflected : node != root;
}

std::uint32_t BeamTree::through_screen(std::uint32_t node, std::uint32_t sheet) {
  constexpr std::uint32_t not_met = 0x80000000u;  // sets such children apart from the footprints on the sheet
  Slot& taken = slot(node, sheet ^ not_met);
  if (taken.child == no_index) taken = {node, sheet ^ not_met, add_screened(node, sheet)};
  const std::uint32_t child = taken.child;
  if (2 * nodes_.size() > slots_.size()) widen();
  return child;
}

std::uint32_t BeamTree::add_screened(std::uint32_t node, std::uint32_t sheet) {
  Node screened{at(node).footprint, at(node).patch};
  screened.unscreened = node, screened.screen = sheet;
  if (beam(node).spherical())
    screened.footprint.outgoing.met = keep(screened_surfaces(at(node), sheet));
  else
    screened.footprint.outgoing.spectrum = keep(screened_spectrum(at(node), sheet));
  nodes_.push_back(screened);
  return end() - 1;
}

Spectrum BeamTree::screened_spectrum(const Node& node, std::uint32_t sheet) {
  const std::vector<ChannelWeights>& through = through_sheet(sheet);
  Spectrum spectrum(through.size());
  for (std::size_t f = 0; f < spectrum.size(); ++f) {
    const ChannelWeights behind = through[f], before = screened_weights(node, f);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        spectrum[f].weight[p][q] = behind[p][0] * before[0][q] + behind[p][1] * before[1][q] - before[p][q];
  }
  return spectrum;
}

// For a perfect conductor the wave that leaves says which one came.
SurfacesMet BeamTree::screened_surfaces(const Node& node, std::uint32_t sheet) const {
  const Beam& leaving = node.footprint.outgoing;
  const Patch &plane = mesh_.patches[node.patch], &screen = mesh_.patches[sheet];
  SurfacesMet met =
      leaving.met ? *leaving.met : with_surface(reflected_spherical(leaving, plane), {plane.normal}, node.reflected);
  met.screens.push_back({screen.normal, screen.material});
  return met;
}

const std::vector<ChannelWeights>& BeamTree::through_sheet(std::uint32_t sheet) {
  const auto [known, is_new] = through_sheets_.try_emplace(sheet);
  for (std::size_t f = 0; is_new && f < surfaces_.wavenumbers.size(); ++f)
    known->second.push_back(raytube::through_screen(surfaces_, mesh_.patches[sheet], f, receive_));
  return known->second;
}

// All sheets between the currents and the receiver, up to the node's own.
ChannelWeights BeamTree::through_screens(std::uint32_t node, std::size_t frequency_index) const {
  if (at(node).unscreened == no_index) return {{{1.0, 0.0}, {0.0, 1.0}}};
  return received_through(through_sheets_.at(at(node).screen)[frequency_index],
                          through_screens(at(node).unscreened, frequency_index));
}

ChannelWeights BeamTree::added_by_screen(std::uint32_t node, std::size_t frequency_index) const {
  ChannelWeights added = through_screens(node, frequency_index);
  const ChannelWeights before = through_screens(at(node).unscreened, frequency_index);
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) added[p][q] -= before[p][q];
  return added;
}

// As far as lines of sight run through sheets, at their end before this one.
ChannelWeights BeamTree::screened_weights(const Node& node, std::size_t frequency_index) const {
  const Beam& beam = node.footprint.outgoing;
  if (node.unscreened != no_index) {
    ChannelWeights sum = screened_weights(at(node.unscreened), frequency_index);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) sum[p][q] += (*beam.spectrum)[frequency_index].weight[p][q];
    return sum;
  }
  const dvec3& normal = mesh_.patches[node.patch].normal;
  if (!node.reflected)
    return radiated(node.from_behind ? -normal : normal, beam.direction,
                    beam.spectrum ? (*beam.spectrum)[frequency_index].field : plain_spectrum(beam.field, 1)[0].field, receive_);
  if (beam.spectrum) return (*beam.spectrum)[frequency_index].weight;
  const auto& w = node.footprint.weight;
  return {{{w[0][0], w[0][1]}, {w[1][0], w[1][1]}}};
}

// Where the child is or would be. Fibonacci hashing: Knuth, The Art of Computer Programming 3, section 6.4.
BeamTree::Slot& BeamTree::slot(std::uint32_t parent, std::uint32_t patch) {
  const std::uint64_t mixed = (std::uint64_t{parent} << 32 | patch) * 0x9e3779b97f4a7c15u;
  for (std::size_t i = mixed >> 32;; ++i) {
    Slot& candidate = slots_[i & (slots_.size() - 1)];
    if (candidate.child == no_index || (candidate.parent == parent && candidate.patch == patch)) return candidate;
  }
}

void BeamTree::widen() {
  std::vector<Slot> before(2 * slots_.size());
  before.swap(slots_);
  for (const Slot& taken : before)
    if (taken.child != no_index) slot(taken.parent, taken.patch) = taken;
}

}  // namespace raytube
