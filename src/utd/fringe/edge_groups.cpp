#include "utd/fringe/edge_groups.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/threads.h"
#include "utd/wedge/work.h"

namespace raytube {

std::vector<LitInterval> cut_at_cells(const Wedge& wedge, std::span<const LitInterval> lit, const ImageLattice& lattice) {
  std::vector<LitInterval> parts;
  for (const auto& [begin, end] : lit) {
    const std::vector<double> shares = lattice.crossings(wedge.at(begin), wedge.at(end));
    for (std::size_t i = 1; i < shares.size(); ++i)
      parts.push_back({begin + shares[i - 1] * (end - begin), begin + shares[i] * (end - begin)});
  }
  return parts;
}

double share_of(std::span<const LitInterval> lit) {
  double share = 0.0;
  for (const LitInterval& part : lit) share += part.end - part.begin;
  return share;
}

EdgesInLook::EdgesInLook(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset, const FringeOptions& options)
    : scene_(scene),
      look_(look),
      subset_(subset),
      options_(options),
      light_(scene.wedges, scene.tracer, look.transmitter(), options.receiver_shadow ? look.receiver() : std::nullopt,
             wavelength(sampling_frequency(subset.frequencies))) {
  if (scene.screens != nullptr)
    cutter_.emplace(*scene.screens, look.transmitter(), look.receiver(), wavelength(sampling_frequency(subset.frequencies)));
}

std::vector<ScreenedInterval> EdgesInLook::lit_parts(std::uint32_t index, const WedgeIncidence& incidence) {
  work_ += work::edge_light;
  return light_.find(index, incidence) ? behind_screens(index, light_.lit()) : std::vector<ScreenedInterval>();
}

std::vector<ScreenedInterval> EdgesInLook::behind_screens(std::uint32_t index, std::span<const LitInterval> parts) const {
  std::vector<ScreenedInterval> screened;
  for (const LitInterval& part : parts)
    if (cutter_)
      cutter_->cut(scene_.wedges[index], part, screened);
    else
      screened.push_back({part, {}});
  return screened;
}

std::uint64_t EdgesInLook::visit_groups(const std::function<void(const EdgeGroup&)>& visit) {
  std::uint64_t wedges_lit = 0;
  std::map<Screens, std::vector<LitEdge>> groups;
  const auto visit_all = [&](const NearPiece& piece) {
    for (auto& [screens, edges] : groups) visit({piece.look, piece.path, screens, piece.middle, std::move(edges)});
    groups.clear();
  };
  for (std::uint32_t index = 0; index < scene_.wedges.size(); ++index) {
    stop_if_cancelled();
    const Wedge& wedge = scene_.wedges[index];
    if (!radiates(scene_, wedge, options_)) continue;
    std::optional<std::vector<ScreenedInterval>> parts;
    bool counts = false;
    for (const NearPiece& piece : look_.pieces(wedge)) {
      const std::optional<EdgeMeeting> met = meeting(scene_, index, piece.look.incident, options_);
      if (!met) continue;
      if (!parts) {
        parts = lit_parts(index, met->incidence);
        if (parts->empty()) break;
      }
      counts = counts || !met->edge_face_only;
      for (const auto& [lit, screens] : *parts) {
        const double begin = std::max(lit.begin, piece.begin), end = std::min(lit.end, piece.end);
        if (begin >= end) continue;
        std::vector<LitEdge>& edges = groups[screens];
        if (edges.empty() || edges.back().wedge != index) edges.push_back({index, *met, {}});
        edges.back().lit.push_back({begin, end});
      }
      if (!look_.far()) visit_all(piece);
    }
    if (parts && !parts->empty() && counts) ++wedges_lit;
  }
  if (look_.far()) visit_all({0.0, 1.0, dvec3(0.0), look_.at(dvec3(0.0)), 0.0});
  return wedges_lit;
}

ScatteringMatrix EdgesInLook::behind(const Screens& screens, const dvec3& point, ScatteringMatrix s,
                                     std::size_t frequency) const {
  if (screens != Screens())
    Passage(*scene_.screens, screens, {subset_, frequency}, look_.transmit_basis(point), look_.receive_basis(point)).transform(s);
  return s;
}

ScatteringMatrix EdgesInLook::received(const EdgeGroup& group, const ScatteringMatrix& s, std::size_t frequency) const {
  ScatteringMatrix there = behind(group.screens, group.middle, s, frequency);
  return group.path == 0.0 ? there : there *= std::polar(1.0, -wavenumber(subset_.frequencies[frequency]) * group.path);
}

}  // namespace raytube
