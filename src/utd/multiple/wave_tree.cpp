#include "utd/multiple/wave_tree.h"

#include <algorithm>
#include <cmath>

#include "utd/wedge/rounding_guard.h"
#include "utd/wedge/work.h"

namespace raytube {

void WaveTree::grow(const StripWave& wave, std::span<const LitInterval> lit) {
  const Wedge& wedge = wedges_[wave.wedge];
  const double length = wedge.length();
  const dvec3 step = (wedge.end - wedge.start) / length;
  rounding_ = rounding_guard * length;
  runs_along_edge_ = false;
  work_ = 0.0;
  waves_.clear();
  bundles_.clear();
  const dvec3 difference = scattered_ - incident_;
  waves_.push_back({wave, {wedge.start, step}, {glm::dot(difference, wedge.start), glm::dot(difference, step)}});
  waves_[0].direct = true;
  for (std::size_t w = 0; w < waves_.size(); ++w) {
    waves_[w].first_bundle = static_cast<std::uint32_t>(bundles_.size());
    if (w == 0) {
      for (const LitInterval& piece : lit) split(waves_[w], piece.begin * length, piece.end * length);
    } else {
      const StripBundle parent = bundles_[waves_[w].parent];
      split(waves_[w], parent.from, parent.to);
    }
    waves_[w].end_bundle = static_cast<std::uint32_t>(bundles_.size());
    if (!runs_over_curved(waves_[w].wave) && (continue_by_images_ || waves_[w].wave.goes_on())) continue_beyond(w);
  }
}

// Neighbours between projected corners that end at one edge are taken together.
void WaveTree::split(const TreeWave& wave, double from, double to) {
  if (runs_over_curved(wave.wave)) return end_bundle(wave, from, to, nullptr);
  const WedgeFace& face = wedges_[wave.wave.wedge].faces[wave.wave.face];
  project_corners(wave, from, to);
  work_ += work::strip_tree + work::strip_corner * static_cast<double>((1 + cuts_.size()) * outlines_.around(face).size());
  double begin = from, last = from;
  const OutlineEdge* edge = nullptr;
  for (const double cut : cuts_) {
    const OutlineEdge* here = strip_end(outlines_, face, wave.wave, wave.line.at((last + cut) / 2));
    if (last > begin && here != edge) {
      end_bundle(wave, begin, last, edge);
      begin = last;
    }
    edge = here;
    last = cut;
  }
  end_bundle(wave, begin, to, edge);
}

void WaveTree::end_bundle(const TreeWave& wave, double from, double to, const OutlineEdge* edge) {
  StripBundle& bundle =
      bundles_.emplace_back(StripBundle{.from = from, .to = to, .start_path = wave.path, .end_path = wave.path});
  if (!edge) return;
  const dvec3& direction = wave.wave.direction;
  bundle.edge = edge;
  bundle.length = edge->distance(wave.line.origin, direction);
  bundle.growth = -glm::dot(wave.line.step, edge->into_face) / glm::dot(direction, edge->into_face);
  const double per_length = glm::dot(scattered_, direction) - 1;
  bundle.end_path.value += per_length * bundle.length;
  bundle.end_path.growth += per_length * bundle.growth;
}

void WaveTree::continue_beyond(std::size_t index) {
  if (waves_[index].wave.strips_left > 1 && meets_edge_alongside(waves_[index].wave)) runs_along_edge_ = true;
  for (std::uint32_t b = waves_[index].first_bundle; b < waves_[index].end_bundle; ++b) {
    const StripBundle& bundle = bundles_[b];
    if (!bundle.edge) continue;
    if (continue_by_images_) mirror(index, b);
    const TreeWave& wave = waves_[index];  // until the next ones are added
    if (const StripBundle* other = same_on_other_side(index, bundle)) {
      for (TreeWave& beyond : std::span(waves_).subspan(other->first_beyond, 2)) beyond.wave.sign *= 2.0;
      continue;
    }
    const auto next = waves_beyond(wedges_, wave.wave, *bundle.edge);
    if (!next) continue;
    bundles_[b].first_beyond = waves_.size();
    const dvec3 direction = wave.wave.direction;
    const EdgeLine there{wave.line.origin + bundle.length * direction, wave.line.step + bundle.growth * direction};
    for (const StripWave& beyond : *next) waves_.push_back({beyond, there, bundle.end_path, b});
  }
}

bool WaveTree::starts_at_half_plane(const TreeWave& wave) const {
  return !wave.direct && wave.wave.mirrors == 0 && ends_sheet(wedges_[wave.wave.wedge]);
}

// A half plane sends the same wave over both of its sides. Where both come to the edge of a half plane, each starts the same two
// waves on the sides of that: those of the other side, which came first, then count for both.
const StripBundle* WaveTree::same_on_other_side(std::size_t index, const StripBundle& bundle) const {
  if (index == 0) return nullptr;
  const TreeWave &here = waves_[index], &other = waves_[index - 1];
  if (here.parent != other.parent || !starts_at_half_plane(here) || !starts_at_half_plane(other)) return nullptr;
  const auto is_same = [&](const StripBundle& each) {
    return each.first_beyond > 0 && each.edge->wedge == bundle.edge->wedge && ends_sheet(wedges_[each.edge->wedge]) &&
           each.from == bundle.from && each.to == bundle.to;
  };
  const auto bundles = std::span(bundles_).subspan(other.first_bundle, other.end_bundle - other.first_bundle);
  const auto same = std::ranges::find_if(bundles, is_same);
  return same == bundles.end() ? nullptr : &*same;
}

// The straight path from the image of the source in the corner's other face is l (s . sigma - s . sigma') longer, l the way to
// the corner and sigma' the mirrored direction.
void WaveTree::mirror(std::size_t index, std::uint32_t bundle) {
  const TreeWave wave = waves_[index];
  const StripBundle& before = bundles_[bundle];
  const auto mirrored = mirrored_wave(wedges_, wave.wave, *before.edge);
  if (!mirrored || runs_over_curved(*mirrored)) return;  // its strips would not be straight
  const dvec3 direction = wave.wave.direction;
  const Linear way{wave.behind.value + before.length, wave.behind.growth + before.growth};
  const double turn = glm::dot(scattered_, direction - mirrored->direction);
  waves_.push_back({.wave = *mirrored,
                    .line = {wave.line.origin + before.length * direction, wave.line.step + before.growth * direction},
                    .path = before.end_path,
                    .parent = bundle,
                    .behind = way,
                    .detour = {wave.detour.value + turn * way.value, wave.detour.growth + turn * way.growth},
                    .direct = wave.direct});
}

// Corners ahead of the strips, projected back along them; and the end.
void WaveTree::project_corners(const TreeWave& wave, double from, double to) {
  const WedgeFace& face = wedges_[wave.wave.wedge].faces[wave.wave.face];
  const dvec3& direction = wave.wave.direction;
  const dvec3 across = glm::cross(face.normal, direction);
  const double per_metre = 1 / glm::dot(wave.line.step, across);
  cuts_.clear();
  for (const OutlineEdge& edge : outlines_.around(face)) {
    const double corner = glm::dot(edge.start - wave.line.origin, across) * per_metre;
    if (!(corner > from + rounding_ && corner < to - rounding_)) continue;
    if (glm::dot(edge.start - wave.line.at(corner), direction) > 0.0) cuts_.push_back(corner);
  }
  std::ranges::sort(cuts_);
  cuts_.push_back(to);
}

bool WaveTree::meets_edge_alongside(const StripWave& wave) const {
  return std::ranges::any_of(outlines_.around(wedges_[wave.wedge].faces[wave.face]), [&](const OutlineEdge& edge) {
    return edge.wedge != wave.wedge && std::abs(glm::dot(wave.direction, edge.into_face)) < along_edge;
  });
}

}  // namespace raytube
