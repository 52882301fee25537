#include "utd/edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "utd/lit_edges.h"
#include "utd/strips.h"

namespace raytube {

namespace {

/// A straight lit piece of an edge in the phase of a look: integral of e^{jq.r} = length sinc(k half_span) e^{jk middle}.
struct Piece {
  double length;     // [m]
  double half_span;  // (s - s') . l / 2 [m]
  double middle;     // (s - s') . c [m], c the piece's midpoint
};

/// The lit pieces of an edge.
void clip(const Wedge& wedge, std::span<const LitInterval> lit, const LookVectors& look, std::vector<Piece>& pieces) {
  const dvec3 difference = look.scattered - look.incident, edge = wedge.end - wedge.start;
  const double length = wedge.length(), slope = glm::dot(difference, edge), start = glm::dot(difference, wedge.start);
  pieces.clear();
  for (const LitInterval& part : lit) {
    const double share = part.end - part.begin;
    pieces.push_back({share * length, share * slope / 2, start + slope * (part.begin + part.end) / 2});
  }
}

Complex phase_integral(std::span<const Piece> pieces, double wavenumber) {
  Complex sum = 0.0;
  for (const Piece& piece : pieces)
    sum += piece.length * sinc(wavenumber * piece.half_span) * std::polar(1.0, wavenumber * piece.middle);
  return sum;
}

void add_product(ScatteringMatrix& sum, const ScatteringMatrix& amplitude, Complex phase) {
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit) sum.at(receive, transmit) += amplitude.at(receive, transmit) * phase;
}

double shortest_wavelength(std::span<const double> frequencies) { return wavelength(*std::ranges::max_element(frequencies)); }

/// First order, one look: adds wedge after wedge, keeping its buffers between them.
class EndlessPass {
 public:
  EndlessPass(const LookVectors& look, std::span<const double> frequencies) : look_(look), frequencies_(frequencies) {
    result_.scattering.resize(frequencies.size());
    result_.windowed.resize(frequencies.size());
  }

  void add(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    ++result_.wedges_lit;
    clip(wedge, lit, look_, pieces_);
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
  std::vector<Piece> pieces_;
  EdgeLookResult result_;
};

/// What the thickness of sheets adds; nothing at sharp edges.
class ThicknessPass {
 public:
  ThicknessPass(const LookVectors& look, std::span<const double> frequencies) : look_(look), frequencies_(frequencies) {}

  /// The current on the rim.
  void add_rim(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    if (wedge.thickness() > 0.0) add(wedge, lit, [&](double k) { return rim_amplitude(wedge, incidence, look_, k); });
  }

  /// At first order, the change of the currents on both sides of the sheet.
  void add_sides(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit) {
    if (wedge.thickness() == 0.0) return;
    for (int side = 0; side < 2; ++side) {
      const WedgeFace& face = wedge.faces[side];
      const FaceIncidence& arriving = incidence.faces[side];
      const ThinEdge thin(wedge, side, arriving, glance_half_cosine(face, arriving, look_.scattered), look_.scattered, true);
      add(
          wedge, lit, [&](double k) { return face_amplitude(thin.endless(k), face, arriving, look_); }, incidence.weight);
    }
  }

  void add_to(std::vector<ScatteringMatrix>& scattering) const {
    for (std::size_t index = 0; index < sums_.size(); ++index) scattering[index] += sums_[index];
  }

 private:
  template <class Amplitude>
  void add(const Wedge& wedge, std::span<const LitInterval> lit, Amplitude amplitude, double weight = 1.0) {
    clip(wedge, lit, look_, pieces_);
    sums_.resize(frequencies_.size());
    for (std::size_t index = 0; index < frequencies_.size(); ++index) {
      const double k = wavenumber(frequencies_[index]);
      add_product(sums_[index], amplitude(k), weight * phase_integral(pieces_, k));
    }
  }

  const LookVectors& look_;
  std::span<const double> frequencies_;
  std::vector<Piece> pieces_;
  std::vector<ScatteringMatrix> sums_;  // empty while there are none
};

/// How a wave meets a wedge. If it comes along a thin sheet only the rim is of account.
struct Meeting {
  Meeting(const Wedge& wedge, const dvec3& incident)
      : incidence(incidence_on(wedge, incident)), rim_only(comes_along_sheet(wedge, incident)) {
    if (!rim_only) return;
    incidence.weight = 1.0;
    incidence.free_side = wedge.faces[0].normal;
  }
  WedgeIncidence incidence;
  bool rim_only;
};

/// First order, one look: every face as endless.
class FirstPass {
 public:
  FirstPass(const LookVectors& look, std::span<const double> frequencies)
      : incident_(look.incident), endless_(look, frequencies), thickness_(look, frequencies) {}

  /// None if the edge adds nothing.
  std::optional<Meeting> meeting(const Wedge& wedge) const {
    if (!wedge.radiates() || wedge.enclosed) return std::nullopt;
    const Meeting result(wedge, incident_);
    return result.incidence.weight > 0.0 ? std::optional(result) : std::nullopt;
  }

  void add(const Wedge& wedge, const Meeting& meeting, std::span<const LitInterval> lit) {
    lit_ = true;
    thickness_.add_rim(wedge, meeting.incidence, lit);
    if (meeting.rim_only) return;
    thickness_.add_sides(wedge, meeting.incidence, lit);
    endless_.add(wedge, meeting.incidence, lit);
  }

  EdgeLookResult take() {
    EdgeLookResult result = endless_.take();
    result.lit = lit_;
    thickness_.add_to(result.scattering);
    return result;
  }

 private:
  dvec3 incident_;
  bool lit_ = false;
  EndlessPass endless_;
  ThicknessPass thickness_;
};

/// Order 2 or more, one look: strips of edge after edge.
class StripPass {
 public:
  StripPass(std::span<const Wedge> wedges, const Outlines& outlines, const LookVectors& look, std::span<const double> frequencies,
            int order, TransitionTier tier, bool mirror_at_folds)
      : wedges_(wedges),
        incident_(look.incident),
        walk_(wedges, outlines, look, frequencies, order, tier, mirror_at_folds),
        thickness_(look, frequencies) {}

  /// None if the edge adds nothing. One that is only grazed, over one face, takes its light from the edge at the other end of
  /// that face.
  std::optional<Meeting> meeting(const Wedge& wedge) const {
    if (!wedge.radiates() || wedge.enclosed) return std::nullopt;
    const Meeting result(wedge, incident_);
    return result.incidence.weight == 1.0 ? std::optional(result) : std::nullopt;
  }

  void add(const Wedge& wedge, const Meeting& meeting, std::span<const LitInterval> lit) {
    result_.lit = true;
    thickness_.add_rim(wedge, meeting.incidence, lit);
    if (meeting.rim_only) return;
    ++result_.wedges_lit;
    walk_.add(static_cast<std::uint32_t>(&wedge - wedges_.data()), meeting.incidence, lit);
  }

  EdgeLookResult take() {
    StripSums sums = walk_.take();
    result_.scattering = std::move(sums.first);
    thickness_.add_to(result_.scattering);
    result_.higher = std::move(sums.higher);
    result_.windowed = std::move(sums.windowed);
    return std::move(result_);
  }

 private:
  std::span<const Wedge> wedges_;
  dvec3 incident_;
  StripWalk walk_;
  ThicknessPass thickness_;
  EdgeLookResult result_;
};

/// The weights of its pieces, each once.
std::vector<double> weights_of(const ReflectedLook& look) {
  std::vector<double> weights;
  for (const LitPieces& pieces : look.pieces) weights.push_back(pieces.weight);
  std::ranges::sort(weights);
  weights.erase(std::unique(weights.begin(), weights.end()), weights.end());
  return weights;
}

void add_weighted(EdgeLookResult& sum, const EdgeLookResult& part, double path, double weight,
                  std::span<const double> frequencies) {
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const Complex factor = std::polar(weight, -wavenumber(frequencies[i]) * path);
    add_product(sum.scattering[i], part.scattering[i], factor);
    add_product(sum.higher[i], part.higher[i], factor);
    if (part.windowed[i]) sum.windowed[i] = true;
  }
  sum.lit = sum.lit || part.lit;
  sum.wedges_lit += part.wedges_lit;
}

template <class Pass>
EdgeLookResult edges_of(std::span<const Wedge> wedges, LitEdges& edges, Pass pass) {
  for (std::uint32_t index = 0; index < wedges.size(); ++index)
    if (const auto meeting = pass.meeting(wedges[index]); meeting && edges.find(index, meeting->incidence))
      pass.add(wedges[index], *meeting, edges.lit());
  return pass.take();
}

/// A piece of an edge [begin, end] in the waves of two antennas, both plane along it.
struct NearPiece {
  double begin, end;  // fractions of the edge
  LookVectors look;   // fields with their amplitudes
  double path;        // added to the phase that the plane waves of `look` have [m]
};

/// Both ways from antenna to antenna over a point, less the ranges.
double path_over(const AntennaPair& antennas, const dvec3& point) {
  return antennas.transmit.ray_to(point).path + antennas.receive.ray_to(point).path;
}

/// A phase over the target that is not told from none [rad].
constexpr double least_phase = 0.01;

/// The waves of antennas where they meet an edge. What edges send on is not continuous where it runs exactly along another one:
/// rays that a whole target sees as parallel are taken so, that the limit of a long range is the far field.
class NearLook {
 public:
  NearLook(const AntennaPair& antennas, double wavenumber, double radius)
      : antennas_(antennas),
        parallel_in_(is_parallel(antennas.transmit, wavenumber, radius)),
        parallel_out_(is_parallel(antennas.receive, wavenumber, radius)) {}

  LookVectors at(const dvec3& point) const {
    const AntennaRay in = antennas_.transmit.ray_to(point), out = antennas_.receive.ray_to(point);
    LookVectors look{in.direction, -out.direction, in.field, {}, out.field};
    if (parallel_in_) look.incident = -antennas_.transmit.radial();
    if (parallel_out_) look.scattered = antennas_.receive.radial();
    for (int q = 0; q < 2; ++q) look.magnetic[q] = glm::cross(look.incident, in.field[q]);
    return look;
  }

 private:
  static bool is_parallel(const Antenna& antenna, double wavenumber, double radius) {
    return wavenumber * radius * radius < least_phase * antenna.range();
  }

  const AntennaPair& antennas_;
  bool parallel_in_, parallel_out_;
};

/// What is left of phase off the linear one at the ends of a piece [rad], and the turn of the directions along it [rad].
constexpr double most_bend = 0.1, most_turn = 0.02;

/// Halves an edge until its pieces are short enough.
void cut(const Wedge& wedge, const AntennaPair& antennas, const NearLook& near, double wavenumber, double begin, double end,
         std::vector<NearPiece>& pieces) {
  const auto point = [&](double fraction) { return glm::mix(wedge.start, wedge.end, fraction); };
  const double middle = 0.5 * (begin + end);
  const dvec3 at = point(middle);
  const double path = path_over(antennas, at),
               bend = 0.5 * (path_over(antennas, point(begin)) + path_over(antennas, point(end))) - path;
  const double half = 0.5 * (end - begin) * wedge.length();
  const double nearest =
      std::min(glm::distance(antennas.transmit.position(), at), glm::distance(antennas.receive.position(), at));
  if (wavenumber * std::abs(bend) > most_bend || half > most_turn * nearest) {
    cut(wedge, antennas, near, wavenumber, begin, middle, pieces);
    return cut(wedge, antennas, near, wavenumber, middle, end, pieces);
  }
  const LookVectors look = near.at(at);
  // The mean of a phase that bends as a parabola is a third of what its ends have.
  pieces.push_back({begin, end, look, path + bend / 3.0 + glm::dot(look.scattered - look.incident, at)});
}

/// One look from a finite distance: adds edge after edge, piece after piece.
class NearSum {
 public:
  NearSum(const AntennaPair& antennas, std::span<const double> frequencies, double radius, bool higher)
      : antennas_(antennas),
        frequencies_(frequencies),
        highest_(wavenumber(std::ranges::max(frequencies))),
        near_(antennas, highest_, radius) {
    sum_.scattering.resize(frequencies.size());
    if (higher) sum_.higher.resize(frequencies.size());
    sum_.windowed.resize(frequencies.size());
  }

  template <class PassOf>
  void add(std::span<const Wedge> wedges, std::uint32_t index, LitEdges& edges, PassOf pass_of) {
    const Wedge& wedge = wedges[index];
    if (!wedge.radiates() || wedge.enclosed) return;
    pieces_.clear();
    cut(wedge, antennas_, near_, highest_, 0.0, 1.0, pieces_);
    bool searched = false, lit = false;
    for (const NearPiece& piece : pieces_) {
      auto pass = pass_of(piece.look);
      const auto meeting = pass.meeting(wedge);
      if (!meeting) continue;
      if (!searched && !edges.find(index, meeting->incidence)) break;
      searched = true;
      if (!clip_to(piece, edges.lit())) continue;
      pass.add(wedge, *meeting, inside_);
      add(pass.take(), piece.path);
      lit = true;
    }
    if (lit) ++sum_.wedges_lit, sum_.lit = true;
  }

  EdgeLookResult take() { return std::move(sum_); }

 private:
  bool clip_to(const NearPiece& piece, std::span<const LitInterval> lit) {
    inside_.clear();
    for (const LitInterval& part : lit) {
      const double begin = std::max(part.begin, piece.begin), end = std::min(part.end, piece.end);
      if (begin < end) inside_.push_back({begin, end});
    }
    return !inside_.empty();
  }

  void add(const EdgeLookResult& part, double path) {
    for (std::size_t i = 0; i < frequencies_.size(); ++i) {
      const Complex factor = std::polar(1.0, -wavenumber(frequencies_[i]) * path);
      add_product(sum_.scattering[i], part.scattering[i], factor);
      if (!part.higher.empty()) add_product(sum_.higher[i], part.higher[i], factor);
      if (part.windowed[i]) sum_.windowed[i] = true;
    }
  }

  const AntennaPair& antennas_;
  std::span<const double> frequencies_;
  double highest_;
  NearLook near_;
  std::vector<NearPiece> pieces_;
  std::vector<LitInterval> inside_;
  EdgeLookResult sum_;
};

}  // namespace

EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, bool receiver_shadow) {
  assert(!frequencies.empty());
  const LookVectors vectors = look_vectors(look);
  LitEdges edges(wedges, tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  return edges_of(wedges, edges, FirstPass(vectors, frequencies));
}

EdgeLookResult fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer, const Look& look,
                                 std::span<const double> frequencies, int order, bool receiver_shadow, TransitionTier tier,
                                 bool mirror_at_folds) {
  assert(!frequencies.empty() && order > 1);
  const LookVectors vectors = look_vectors(look);
  LitEdges edges(wedges, tracer, vectors, shortest_wavelength(frequencies), receiver_shadow);
  return edges_of(wedges, edges, StripPass(wedges, outlines, vectors, frequencies, order, tier, mirror_at_folds));
}

EdgeLookResult fringe_scattering_near(std::span<const Wedge> wedges, const Outlines& outlines, const Tracer& tracer,
                                      const AntennaPair& antennas, std::span<const double> frequencies, int order,
                                      bool receiver_shadow, TransitionTier tier) {
  assert(!frequencies.empty() && order >= 1);
  std::optional<Viewpoint> receiver;
  if (receiver_shadow) receiver = Viewpoint::at(antennas.receive.position());
  LitEdges edges(wedges, tracer, Viewpoint::at(antennas.transmit.position()), receiver, shortest_wavelength(frequencies));
  NearSum sum(antennas, frequencies, tracer.mesh().radius, order > 1);
  for (std::uint32_t index = 0; index < wedges.size(); ++index) {
    if (order == 1)
      sum.add(wedges, index, edges, [&](const LookVectors& look) { return FirstPass(look, frequencies); });
    else
      sum.add(wedges, index, edges,
              [&](const LookVectors& look) { return StripPass(wedges, outlines, look, frequencies, order, tier, false); });
  }
  return sum.take();
}

EdgeLookResult reflected_fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines,
                                           std::span<const ReflectedLook> looks, std::span<const double> frequencies, int order,
                                           TransitionTier tier, bool mirror_at_folds) {
  assert(!frequencies.empty() && order >= 1);
  EdgeLookResult result;
  result.scattering.resize(frequencies.size());
  result.higher.resize(frequencies.size());
  result.windowed.resize(frequencies.size());
  for (const ReflectedLook& look : looks)
    for (const double weight : weights_of(look)) {
      StripPass pass(wedges, outlines, look.look, frequencies, order, tier, mirror_at_folds);
      for (const LitPieces& pieces : look.pieces)
        if (const auto meeting = pass.meeting(wedges[pieces.wedge]); meeting && pieces.weight == weight && !pieces.lit.empty())
          pass.add(wedges[pieces.wedge], *meeting, pieces.lit);
      add_weighted(result, pass.take(), look.path, weight, frequencies);
    }
  return result;
}

}  // namespace raytube
