#include "utd/fringe/edge_groups.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/threads.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

/// An edge that is met exactly along its sheet is seen from the sheet's front.
WedgeIncidence incidence_from_front(const Wedge& wedge, const dvec3& incident) {
  WedgeIncidence incidence = incidence_on(wedge, incident);
  const WedgeFace& sheet = wedge.faces[0];
  if (incidence.weight < 1.0 && std::abs(glm::dot(incident, sheet.normal)) <= lit_threshold) incidence.free_side = sheet.normal;
  return incidence;
}

}  // namespace

double share_of(std::span<const LitInterval> lit) {
  double share = 0.0;
  for (const LitInterval& part : lit) share += part.end - part.begin;
  return share;
}

EdgesInLook::EdgesInLook(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset, const FringeOptions& options)
    : scene_(scene),
      look_(look),
      subset_(subset),
      order_(options.order),
      light_(scene.wedges, scene.tracer, look.transmitter(), options.receiver_shadow ? look.receiver() : std::nullopt,
             wavelength(sampling_frequency(subset.frequencies))) {
  if (scene.screens != nullptr)
    cutter_.emplace(*scene.screens, look.transmitter(), look.receiver(), wavelength(sampling_frequency(subset.frequencies)));
}

std::vector<ScreenedInterval> EdgesInLook::parts_of(const Wedge& wedge, std::span<const LitInterval> lit) const {
  std::vector<ScreenedInterval> parts;
  for (const LitInterval& part : lit)
    if (cutter_)
      cutter_->cut(wedge, part, parts);
    else
      parts.push_back({part, {}});
  return parts;
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
    if (!wedge.radiates() && (scene_.materials == nullptr || !scene_.materials->radiates(wedge))) continue;
    std::optional<std::vector<ScreenedInterval>> parts;
    bool counts = false;
    for (const NearPiece& piece : look_.pieces(wedge)) {
      const std::optional<EdgeMeeting> met = meeting(scene_, index, piece.look.incident, order_);
      if (!met) continue;
      if (!parts) {
        work_ += work::edge_light;
        if (!light_.find(index, met->incidence)) break;
        parts = parts_of(wedge, light_.lit());
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
    if (parts && counts) ++wedges_lit;
  }
  if (look_.far()) visit_all({0.0, 1.0, dvec3(0.0), look_.at(dvec3(0.0)), 0.0});
  return wedges_lit;
}

// The part of an edge of a solid between two dark faces that has waves, as both its corners are seen: as much as is lit of the
// edges that meet it there, at the corner of which less is.
double EdgesInLook::share_between_corners(const SolidEdge& edge, const dvec3& incident) {
  if (!edge.ends[0].sees(-incident) || !edge.ends[1].sees(-incident)) return 0.0;
  double share = 1.0;
  for (const SolidEnd& end : edge.ends) {
    double most = 0.0;
    for (const std::uint32_t other : end.beside) {
      const Wedge& wedge = scene_.wedges[other];
      if (light_.find(other, incidence_from_front(wedge, look_.incident(wedge.at(0.5)))))
        most = std::max(most, share_of(light_.lit()));
    }
    share = std::min(share, most);
  }
  return share;
}

std::vector<LitInterval> EdgesInLook::lit_between_corners(std::uint32_t index) {
  const Wedge& wedge = scene_.wedges[index];
  const dvec3 incident = look_.incident(wedge.at(0.5));
  const WedgeIncidence incidence = incidence_from_front(wedge, incident);
  const SolidEdge* solid = scene_.corners->solid(index);
  if (incidence.weight > 0.0 || solid == nullptr) {
    if (!light_.find(index, incidence)) return {};
    return {light_.lit().begin(), light_.lit().end()};
  }
  const double share = share_between_corners(*solid, incident);
  return share > 0.0 ? std::vector<LitInterval>{{0.0, share}} : std::vector<LitInterval>();
}

void EdgesInLook::visit_corner_waves(const std::function<void(const CornerWaveGroup&)>& visit) {
  if (scene_.corners == nullptr) return;
  for (std::uint32_t index = 0; index < scene_.wedges.size(); ++index) {
    if (!scene_.corners->run_along(index)) continue;
    const std::vector<LitInterval> lit = lit_between_corners(index);
    if (lit.empty()) continue;
    work_ += work::edge_light;
    const Wedge& wedge = scene_.wedges[index];
    const dvec3 middle = wedge.at(0.5);
    std::map<Screens, std::vector<LitInterval>> groups;
    for (const auto& [part, screens] : parts_of(wedge, lit)) groups[screens].push_back(part);
    for (const auto& [screens, parts] : groups)
      visit({index, parts, screens, middle, scene_.corners->part(index, look_.incident(middle))});
  }
}

void EdgesInLook::add_corner_waves(std::uint32_t wedge, double share, std::span<const double> frequencies,
                                   std::span<ScatteringMatrix> sum) const {
  const std::array<dvec3, 2> corners = scene_.corners->corners_of(wedge);
  const auto visit = [&](const dvec3& corner) {
    return CornerWaves::Visit{look_.at(corner), look_.arriving(corner), look_.leaving(corner)};
  };
  scene_.corners->add(wedge, share, {visit(corners[0]), visit(corners[1])}, frequencies, sum);
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
