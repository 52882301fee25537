#include "utd/fringe/edge_sum.h"

#include <utility>

#include "utd/wedge/work.h"

namespace raytube {

bool radiates(const EdgeScene& scene, const Wedge& wedge, const FringeOptions& options) {
  return options.of_materials ? scene.materials != nullptr && scene.materials->radiates(wedge) : wedge.radiates();
}

std::optional<EdgeMeeting> meeting(const EdgeScene& scene, std::uint32_t index, const dvec3& incident,
                                   const FringeOptions& options) {
  const Wedge& wedge = scene.wedges[index];
  if (!radiates(scene, wedge, options)) return std::nullopt;
  if (options.of_materials) {
    const auto met = scene.materials->meeting(wedge, incident);
    return met ? std::optional(EdgeMeeting{*met}) : std::nullopt;
  }
  EdgeMeeting result{incidence_on(wedge, incident), comes_along_plate(wedge, incident)};
  if (result.edge_face_only) result.incidence.weight = 1.0, result.incidence.free_side = wedge.faces[0].normal;
  const double weight = result.incidence.weight;
  return weight == 1.0 || (options.order == 1 && weight > 0.0) ? std::optional(result) : std::nullopt;
}

EdgeSum::EdgeSum(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies,
                 const FringeOptions& options)
    : wedges_(scene.wedges), look_(look), frequencies_(frequencies), result_(frequencies.size(), options.order) {
  if (options.of_materials) materials_.emplace(scene, look, frequencies, options.order);
  if (options.of_materials || options.order == 1) return;
  strips_.emplace(scene.wedges, scene.outlines, scene.curved, look, frequencies, options.order, options.continue_by_images);
  strips_->keep_rays(options.rays);
}

void EdgeSum::add(const LitEdge& edge) {
  const Wedge& wedge = wedges_[edge.wedge];
  result_.lit = true;
  if (materials_) return materials_->add(edge.wedge, edge.meeting.incidence, edge.lit);
  add_edge_face(wedge, edge.meeting, edge.lit);
  if (edge.meeting.edge_face_only) return;
  if (strips_) return strips_->add(edge.wedge, edge.meeting.incidence, edge.lit);
  add_first_order(wedge, edge);
}

void EdgeSum::add_first_order(const Wedge& wedge, const LitEdge& edge) {
  add_sides(wedge, edge.meeting, edge.lit);
  find_phases(wedge, edge.lit, look_, phases_);
  result_.work += work::edge_amplitude * static_cast<double>(frequencies_.size());
  const EdgeAmplitude amplitude = edge_amplitude(wedge, edge.meeting.incidence, look_);
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const double k = wavenumber(frequencies_[f]);
    bool windowed = false;
    add_product(result_.scattering[f], amplitude_at(amplitude, k, windowed), phase_integral(phases_, k));
    if (windowed) result_.windowed[f] = true;
  }
}

// What the thickness of a thin plate adds.
template <class Amplitude>
void EdgeSum::add_thickness(const Wedge& wedge, std::span<const LitInterval> lit, Amplitude amplitude) {
  find_phases(wedge, lit, look_, phases_);
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const double k = wavenumber(frequencies_[f]);
    add_product(result_.scattering[f], amplitude(k), phase_integral(phases_, k));
  }
}

// The current on the narrow face of the plate's edge.
void EdgeSum::add_edge_face(const Wedge& wedge, const EdgeMeeting& meeting, std::span<const LitInterval> lit) {
  if (wedge.thickness() == 0.0) return;
  add_thickness(wedge, lit, [&](double k) { return edge_face_amplitude(wedge, meeting.incidence, look_, k); });
}

// At first order, the change of the currents on both sides of the plate.
void EdgeSum::add_sides(const Wedge& wedge, const EdgeMeeting& meeting, std::span<const LitInterval> lit) {
  for (int side = 0; side < 2 && wedge.thickness() > 0.0; ++side) {
    const WedgeFace& face = wedge.faces[side];
    const FaceIncidence& arriving = meeting.incidence.faces[side];
    const ThinPlateCorrection thin(wedge, side, arriving, grazing_half_cosine(face, arriving, look_.scattered), look_.scattered,
                                   true);
    add_thickness(wedge, lit, [&](double k) {
      return face_amplitude(thin.untruncated(k), face, arriving, look_) *= meeting.incidence.weight;
    });
  }
}

std::vector<ImageEdge> EdgeSum::pieces(const LitEdge& edge, std::span<const LitInterval> parts, const PathPlace& place) {
  std::vector<ImageEdge> all;
  const Wedge& wedge = wedges_[edge.wedge];
  if (!edge.meeting.edge_face_only) {
    StripPieces pieces{place};
    strips_->keep_pieces(&pieces);
    strips_->add(edge.wedge, edge.meeting.incidence, edge.lit);
    all = strips_->take_pieces();
  }
  for (const LitInterval& part : parts) {
    if (wedge.thickness() == 0.0) break;
    ScatteringMatrix& s = result_.scattering.front() = {};
    add_edge_face(wedge, edge.meeting, std::span(&part, 1));
    const dvec3 middle = wedge.at(0.5 * (part.begin + part.end)),
                at = place.at(middle, middle, glm::dot(look_.scattered - look_.incident, middle));
    all.push_back({at, at, s});
  }
  return all;
}

EdgeLookResult EdgeSum::take() {
  if (strips_) {
    StripSums sums = strips_->take();
    for (std::size_t f = 0; f < frequencies_.size(); ++f) result_.scattering[f] += sums.first[f];
    result_.higher = std::move(sums.higher);
    result_.windowed = std::move(sums.windowed);
    result_.work += sums.work;
  }
  if (materials_) materials_->add_to(result_);
  return std::move(result_);
}

}  // namespace raytube
