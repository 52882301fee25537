#include "utd/fringe/edge_pass.h"

#include <algorithm>
#include <utility>

#include "scene/frequency_bands.h"
#include "utd/wedge/work.h"

namespace raytube {

double shortest_wavelength(std::span<const double> frequencies) { return wavelength(sampling_frequency(frequencies)); }

EdgeMeeting::EdgeMeeting(const Wedge& wedge, const dvec3& incident)
    : incidence(incidence_on(wedge, incident)), edge_face_only(comes_along_plate(wedge, incident)) {
  if (!edge_face_only) return;
  incidence.weight = 1.0;
  incidence.free_side = wedge.faces[0].normal;
}

// --- thickness ---

template <class Amplitude>
void ThicknessPass::add(const Wedge& wedge, std::span<const LitInterval> lit, Amplitude amplitude, double weight) {
  find_phases(wedge, lit, look_, pieces_);
  sums_.resize(frequencies_.size());
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const double k = wavenumber(frequencies_[f]);
    add_product(sums_[f], amplitude(k), weight * phase_integral(pieces_, k));
  }
}

void ThicknessPass::add_edge_face(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  if (wedge.thickness() > 0.0) add(wedge, lit, [&](double k) { return edge_face_amplitude(wedge, incidence, look_, k); });
}

void ThicknessPass::add_sides(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
  if (wedge.thickness() == 0.0) return;
  for (int side = 0; side < 2; ++side) {
    const WedgeFace& face = wedge.faces[side];
    const FaceIncidence& arriving = incidence.faces[side];
    const ThinPlateCorrection thin(wedge, side, arriving, grazing_half_cosine(face, arriving, look_.scattered), look_.scattered,
                                   true);
    const auto amplitude = [&](double k) { return face_amplitude(thin.untruncated(k), face, arriving, look_); };
    add(wedge, lit, amplitude, incidence.weight);
  }
}

void ThicknessPass::add_to(std::vector<ScatteringMatrix>& scattering) const {
  for (std::size_t f = 0; f < sums_.size(); ++f) scattering[f] += sums_[f];
}

// --- first order ---

FirstOrderEdges::FirstOrderEdges(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies)
    : wedges_(scene.wedges),
      look_(look),
      frequencies_(frequencies),
      thickness_(look, frequencies),
      materials_(scene, look, frequencies, 1) {
  result_.scattering.resize(frequencies.size());
  result_.windowed.resize(frequencies.size());
}

std::optional<EdgeMeeting> FirstOrderEdges::meeting(std::uint32_t index) const {
  if (const auto other = materials_.meeting(index)) return EdgeMeeting(*other);
  if (!wedges_[index].radiates()) return std::nullopt;
  const EdgeMeeting result(wedges_[index], look_.incident);
  return result.incidence.weight == 0.0 ? std::nullopt : std::optional(result);
}

void FirstOrderEdges::add(std::uint32_t index, const EdgeMeeting& meeting, std::span<const LitInterval> lit) {
  const Wedge& wedge = wedges_[index];
  result_.lit = true;
  if (meeting.of_materials) {
    ++result_.wedges_lit;
    return materials_.add(index, meeting.incidence, lit);
  }
  thickness_.add_edge_face(wedge, meeting.incidence, lit);
  if (meeting.edge_face_only) return;
  thickness_.add_sides(wedge, meeting.incidence, lit);
  ++result_.wedges_lit;
  find_phases(wedge, lit, look_, pieces_);
  result_.work += work::edge_amplitude * static_cast<double>(frequencies_.size());
  radiate(edge_amplitude(wedge, meeting.incidence, look_));
}

void FirstOrderEdges::radiate(const EdgeAmplitude& amplitude) {
  for (std::size_t f = 0; f < frequencies_.size(); ++f) {
    const double k = wavenumber(frequencies_[f]);
    bool windowed = false;
    add_product(result_.scattering[f], amplitude_at(amplitude, k, windowed), phase_integral(pieces_, k));
    if (windowed) result_.windowed[f] = true;
  }
}

EdgeLookResult FirstOrderEdges::take() {
  thickness_.add_to(result_.scattering);
  materials_.add_to(result_);
  return std::move(result_);
}

// --- strips ---

StripEdges::StripEdges(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies,
                       const FringeOptions& options)
    : wedges_(scene.wedges),
      look_(look),
      frequencies_(frequencies),
      multiple_(scene.wedges, scene.outlines, scene.curved, look, frequencies, options.order, options.continue_by_images),
      thickness_(look, frequencies),
      materials_(scene, look, frequencies, options.order) {
  multiple_.keep_rays(options.rays);
}

std::optional<EdgeMeeting> StripEdges::meeting(std::uint32_t index) const {
  if (const auto other = materials_.meeting(index)) return EdgeMeeting(*other);
  if (!wedges_[index].radiates()) return std::nullopt;
  const EdgeMeeting result(wedges_[index], look_.incident);
  return result.incidence.weight == 1.0 ? std::optional(result) : std::nullopt;
}

void StripEdges::add(std::uint32_t index, const EdgeMeeting& meeting, std::span<const LitInterval> lit) {
  result_.lit = true;
  if (meeting.of_materials) {
    ++result_.wedges_lit;
    return materials_.add(index, meeting.incidence, lit);
  }
  thickness_.add_edge_face(wedges_[index], meeting.incidence, lit);
  if (meeting.edge_face_only) return;
  ++result_.wedges_lit;
  multiple_.add(index, meeting.incidence, lit);
}

std::vector<ImageEdge> StripEdges::pieces(std::uint32_t index, const EdgeMeeting& meeting, std::span<const LitInterval> lit,
                                          std::span<const LitInterval> parts, const PathPlace& place) {
  std::vector<ImageEdge> all;
  const Wedge& wedge = wedges_[index];
  if (!meeting.edge_face_only) {
    StripPieces pieces{place};
    multiple_.keep_pieces(&pieces);
    multiple_.add(index, meeting.incidence, lit);
    all = multiple_.take_pieces();
  }
  for (const LitInterval& part : parts) {
    if (wedge.thickness() == 0.0) break;
    ThicknessPass face(look_, frequencies_);
    face.add_edge_face(wedge, meeting.incidence, std::span(&part, 1));
    std::vector<ScatteringMatrix> s(1);
    face.add_to(s);
    const dvec3 middle = point_on(wedge, (part.begin + part.end) / 2),
                at = place.at(middle, middle, glm::dot(look_.scattered - look_.incident, middle));
    all.push_back({at, at, s[0]});
  }
  return all;
}

EdgeLookResult StripEdges::take() {
  StripSums sums = multiple_.take();
  result_.scattering = std::move(sums.first);
  thickness_.add_to(result_.scattering);
  result_.higher = std::move(sums.higher);
  result_.windowed = std::move(sums.windowed);
  result_.work += sums.work;
  materials_.add_to(result_);
  return std::move(result_);
}

}  // namespace raytube
