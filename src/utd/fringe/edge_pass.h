// One look at the edges of a target, edge after edge: at first order, or as strips.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "utd/fringe/edges.h"
#include "utd/multiple/multiple_diffraction.h"

namespace raytube {

/// A straight lit piece of an edge in the phase of a look: integral of e^{jq.r} = length sinc(k half_span) e^{jk middle}.
struct EdgePhase {
  double length;     // [m]
  double half_span;  // (s - s') . l / 2 [m]
  double middle;     // (s - s') . c [m], c the piece's midpoint
};

/// The lit pieces of an edge.
inline void clip_phases(const Wedge& wedge, std::span<const LitInterval> lit, const LookVectors& look,
                        std::vector<EdgePhase>& pieces) {
  const dvec3 difference = look.scattered - look.incident, edge = wedge.end - wedge.start;
  const double length = wedge.length(), slope = glm::dot(difference, edge), start = glm::dot(difference, wedge.start);
  pieces.clear();
  for (const LitInterval& part : lit) {
    const double share = part.end - part.begin;
    pieces.push_back({share * length, share * slope / 2, start + slope * (part.begin + part.end) / 2});
  }
}

inline Complex phase_integral(std::span<const EdgePhase> pieces, double wavenumber) {
  Complex sum = 0.0;
  for (const EdgePhase& piece : pieces)
    sum += piece.length * sinc(wavenumber * piece.half_span) * std::polar(1.0, wavenumber * piece.middle);
  return sum;
}

inline void add_product(ScatteringMatrix& sum, const ScatteringMatrix& amplitude, Complex phase) {
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit) sum.at(receive, transmit) += amplitude.at(receive, transmit) * phase;
}

inline double shortest_wavelength(std::span<const double> frequencies) {
  return wavelength(*std::ranges::max_element(frequencies));
}

/// First order, one look: adds wedge after wedge, keeping its buffers between them.
class FirstOrderPass {
 public:
  FirstOrderPass(const LookVectors& look, std::span<const double> frequencies) : look_(look), frequencies_(frequencies) {
    result_.scattering.resize(frequencies.size());
    result_.windowed.resize(frequencies.size());
  }

  void add(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    ++result_.wedges_lit;
    clip_phases(wedge, lit, look_, pieces_);
    radiate(edge_amplitude(wedge, incidence, look_));
  }

  EdgeLookResult take() { return std::move(result_); }

 private:
  void radiate(const EdgeAmplitude& amplitude) {
    for (std::size_t index = 0; index < frequencies_.size(); ++index) {
      const double k = wavenumber(frequencies_[index]);
      bool windowed = false;
      add_product(result_.scattering[index], amplitude_at(amplitude, k, windowed), phase_integral(pieces_, k));
      if (windowed) result_.windowed[index] = true;
    }
  }

  const LookVectors& look_;
  std::span<const double> frequencies_;
  std::vector<EdgePhase> pieces_;
  EdgeLookResult result_;
};

/// What the thickness of sheets adds; nothing at sharp edges.
class ThicknessPass {
 public:
  ThicknessPass(const LookVectors& look, std::span<const double> frequencies) : look_(look), frequencies_(frequencies) {}

  /// The current on the rim.
  void add_edge_face(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    if (wedge.thickness() > 0.0) add(wedge, lit, [&](double k) { return edge_face_amplitude(wedge, incidence, look_, k); });
  }

  /// At first order, the change of the currents on both sides of the sheet.
  void add_sides(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    if (wedge.thickness() == 0.0) return;
    for (int side = 0; side < 2; ++side) {
      const WedgeFace& face = wedge.faces[side];
      const FaceIncidence& arriving = incidence.faces[side];
      const ThinPlateEdge thin(wedge, side, arriving, grazing_half_cosine(face, arriving, look_.scattered), look_.scattered,
                               true);
      add(
          wedge, lit, [&](double k) { return face_amplitude(thin.untruncated(k), face, arriving, look_); }, incidence.weight);
    }
  }

  void add_to(std::vector<ScatteringMatrix>& scattering) const {
    for (std::size_t index = 0; index < sums_.size(); ++index) scattering[index] += sums_[index];
  }

 private:
  template <class Amplitude>
  void add(const Wedge& wedge, std::span<const LitInterval> lit, Amplitude amplitude, double weight = 1.0) {
    clip_phases(wedge, lit, look_, pieces_);
    sums_.resize(frequencies_.size());
    for (std::size_t index = 0; index < frequencies_.size(); ++index) {
      const double k = wavenumber(frequencies_[index]);
      add_product(sums_[index], amplitude(k), weight * phase_integral(pieces_, k));
    }
  }

  const LookVectors& look_;
  std::span<const double> frequencies_;
  std::vector<EdgePhase> pieces_;
  std::vector<ScatteringMatrix> sums_;  // empty while there are none
};

/// How a wave meets a wedge. If it comes along a thin sheet only the rim is of account.
struct Meeting {
  Meeting(const Wedge& wedge, const dvec3& incident)
      : incidence(incidence_on(wedge, incident)), edge_face_only(comes_along_plate(wedge, incident)) {
    if (!edge_face_only) return;
    incidence.weight = 1.0;
    incidence.free_side = wedge.faces[0].normal;
  }
  WedgeIncidence incidence;
  bool edge_face_only;
};

/// First order, one look: edge after edge.
class FirstOrderEdges {
 public:
  FirstOrderEdges(std::span<const Wedge> wedges, const LookVectors& look, std::span<const double> frequencies)
      : wedges_(wedges), incident_(look.incident), pass_(look, frequencies), thickness_(look, frequencies) {}

  /// None if the edge adds nothing.
  std::optional<Meeting> meeting(std::uint32_t index) const {
    if (!wedges_[index].radiates()) return std::nullopt;
    const Meeting result(wedges_[index], incident_);
    return result.incidence.weight == 0.0 ? std::nullopt : std::optional(result);
  }

  void add(std::uint32_t index, const Meeting& meeting, std::span<const LitInterval> lit) {
    lit_ = true;
    thickness_.add_edge_face(wedges_[index], meeting.incidence, lit);
    if (meeting.edge_face_only) return;
    thickness_.add_sides(wedges_[index], meeting.incidence, lit);
    pass_.add(wedges_[index], meeting.incidence, lit);
  }

  EdgeLookResult take() {
    EdgeLookResult result = pass_.take();
    result.lit = lit_;
    thickness_.add_to(result.scattering);
    return result;
  }

 private:
  std::span<const Wedge> wedges_;
  dvec3 incident_;
  FirstOrderPass pass_;
  ThicknessPass thickness_;
  bool lit_ = false;
};

/// Order 2 or more, one look: strips of edge after edge.
class StripPass {
 public:
  StripPass(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look, std::span<const double> frequencies,
            int order, TransitionTier tier, bool continue_by_images)
      : wedges_(wedges),
        incident_(look.incident),
        multiple_(wedges, outlines, look, frequencies, order, tier, continue_by_images),
        thickness_(look, frequencies) {}

  /// None if the edge adds nothing. One that is only grazed, over one face, takes its light from the edge at the other end of
  /// that face.
  std::optional<Meeting> meeting(std::uint32_t index) const {
    if (!wedges_[index].radiates()) return std::nullopt;
    const Meeting result(wedges_[index], incident_);
    return result.incidence.weight == 1.0 ? std::optional(result) : std::nullopt;
  }

  void add(std::uint32_t index, const Meeting& meeting, std::span<const LitInterval> lit) {
    result_.lit = true;
    thickness_.add_edge_face(wedges_[index], meeting.incidence, lit);
    if (meeting.edge_face_only) return;
    ++result_.wedges_lit;
    multiple_.add(index, meeting.incidence, lit);
  }

  EdgeLookResult take() {
    StripSums sums = multiple_.take();
    result_.scattering = std::move(sums.first);
    thickness_.add_to(result_.scattering);
    result_.higher = std::move(sums.higher);
    result_.windowed = std::move(sums.windowed);
    return std::move(result_);
  }

 private:
  std::span<const Wedge> wedges_;
  dvec3 incident_;
  MultipleDiffraction multiple_;
  ThicknessPass thickness_;
  EdgeLookResult result_;
};

}  // namespace raytube
