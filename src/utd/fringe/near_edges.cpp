#include "utd/fringe/near_edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/work.h"
#include "utd/fringe/corner_pass.h"
#include "utd/wedge/near_look.h"

namespace raytube {

namespace {

/// A piece of an edge [begin, end] in the waves of two antennas, both plane along it.
struct NearPiece {
  double begin, end;  // fractions of the edge
  LookVectors look;   // fields with their amplitudes
  double path;        // added to the phase that the plane waves of `look` have [m]
};

/// What is left of phase off the linear one at the ends of a piece [rad], and the turn of the directions along it [rad].
constexpr double most_bend = 0.1, most_turn = 0.02;

/// Cuts edges into pieces along which the waves of both antennas are plane.
class PieceCutter {
 public:
  PieceCutter(const AntennaPair& antennas, double wavenumber, double radius)
      : near_(antennas, wavenumber, radius), wavenumber_(wavenumber) {}

  /// Halves the part [begin, end] of an edge until its pieces are short enough.
  void cut(const Wedge& wedge, double begin, double end, std::vector<NearPiece>& pieces) const {
    const auto point = [&](double fraction) { return glm::mix(wedge.start, wedge.end, fraction); };
    const double middle = 0.5 * (begin + end);
    const dvec3 at = point(middle);
    const double path = near_.path_over(at), bend = 0.5 * (near_.path_over(point(begin)) + near_.path_over(point(end))) - path;
    const double half = 0.5 * (end - begin) * wedge.length();
    if (wavenumber_ * std::abs(bend) > most_bend || half > most_turn * near_.nearest(at)) {
      cut(wedge, begin, middle, pieces);
      return cut(wedge, middle, end, pieces);
    }
    const LookVectors look = near_.at(at);
    // The mean of a phase that bends as a parabola is a third of what its ends have.
    pieces.push_back({begin, end, look, path + bend / 3.0 + glm::dot(look.scattered - look.incident, at)});
  }

 private:
  NearLook near_;
  double wavenumber_;
};

/// The lit pieces of edges in one look from a finite distance.
class NearEdges {
 public:
  NearEdges(const AntennaPair& antennas, std::span<const double> frequencies, double radius)
      : frequencies_(frequencies), cutter_(antennas, wavenumber(std::ranges::max(frequencies)), radius) {}

  /// Calls visit(piece, edges, meeting, lit) for those of wedge `index`, `edges` made by `make`, that of at_order().
  template <class Make, class Visit>
  void for_each(std::span<const Wedge> wedges, std::uint32_t index, LitEdges& light, Make make, Visit visit) {
    const Wedge& wedge = wedges[index];
    if (!wedge.radiates()) return;
    pieces_.clear();
    cutter_.cut(wedge, 0.0, 1.0, pieces_);
    bool searched = false;
    for (const NearPiece& piece : pieces_) {
      auto edges = make(piece.look, frequencies_);
      const auto meeting = edges.meeting(index);
      if (!meeting) continue;
      if (!searched && !light.find(index, meeting->incidence)) break;
      searched = true;
      if (clip_to(piece, light.lit())) visit(piece, edges, *meeting, std::span<const LitInterval>(inside_));
    }
  }

 private:
  bool clip_to(const NearPiece& piece, std::span<const LitInterval> lit) {
    inside_.clear();
    for (const LitInterval& part : lit) {
      const double begin = std::max(part.begin, piece.begin), end = std::min(part.end, piece.end);
      if (begin < end) inside_.push_back({begin, end});
    }
    return !inside_.empty();
  }

  std::span<const double> frequencies_;
  PieceCutter cutter_;
  std::vector<NearPiece> pieces_;
  std::vector<LitInterval> inside_;
};

/// Adds edge after edge, piece after piece.
class NearSum {
 public:
  NearSum(const AntennaPair& antennas, std::span<const double> frequencies, double radius, bool higher)
      : frequencies_(frequencies), near_(antennas, frequencies, radius) {
    sum_.scattering.resize(frequencies.size());
    if (higher) sum_.higher.resize(frequencies.size());
    sum_.windowed.resize(frequencies.size());
  }

  template <class Make>
  void add(std::span<const Wedge> wedges, std::uint32_t index, LitEdges& light, Make make) {
    bool lit = false;
    near_.for_each(wedges, index, light, make, [&](const NearPiece& piece, auto& edges, const auto& meeting, auto inside) {
      edges.add(index, meeting, inside);
      const EdgeLookResult part = edges.take();
      add(part, piece.path);
      sum_.lit = sum_.lit || part.lit;
      lit = lit || part.wedges_lit > 0;
    });
    if (lit) ++sum_.wedges_lit;
  }

  EdgeLookResult take() { return std::move(sum_); }

 private:
  void add(const EdgeLookResult& part, double path) {
    for (std::size_t i = 0; i < frequencies_.size(); ++i) {
      const Complex factor = std::polar(1.0, -wavenumber(frequencies_[i]) * path);
      add_product(sum_.scattering[i], part.scattering[i], factor);
      if (!part.higher.empty()) add_product(sum_.higher[i], part.higher[i], factor);
      if (part.windowed[i]) sum_.windowed[i] = true;
    }
  }

  std::span<const double> frequencies_;
  NearEdges near_;
  EdgeLookResult sum_;
};

/// Calls add(index, lit, visits) for the edges between corners; the waves of the antennas are plane at each corner.
template <class Add>
void for_corner_waves_near(const EdgeScene& scene, const AntennaPair& antennas, std::span<const double> frequencies,
                           LitEdges& light, Add add) {
  const NearLook near(antennas, wavenumber(std::ranges::max(frequencies)), scene.tracer.mesh().radius);
  const auto incident = [&](const Wedge& wedge) { return near.at(0.5 * (wedge.start + wedge.end)).incident; };
  const auto visit = [&](const dvec3& corner) {
    return CornerWaves::Visit{near.at(corner), -near.path_in(corner), -near.path_out(corner)};
  };
  for_edges_between_corners(scene, light, incident, [&](std::uint32_t index, std::span<const LitInterval> lit) {
    const std::array<dvec3, 2> corners = scene.corners->corners_of(index);
    add(index, lit, std::array<CornerWaves::Visit, 2>{visit(corners[0]), visit(corners[1])});
  });
}

LitEdges light_of(const EdgeScene& scene, const AntennaPair& antennas, std::span<const double> frequencies,
                  const FringeOptions& options) {
  std::optional<Viewpoint> receiver;
  if (options.receiver_shadow) receiver = Viewpoint::at(antennas.receive.position());
  const Viewpoint transmitter = Viewpoint::at(antennas.transmit.position());
  return LitEdges(scene.wedges, scene.tracer, transmitter, receiver, shortest_wavelength(frequencies));
}

/// The pieces of one edge that is lit, but for its corner waves.
template <class Make>
void add_pieces(const EdgeScene& scene, std::uint32_t index, NearEdges& near, LitEdges& light,
                std::span<const double> frequencies, const PieceRequest& request, Make make, std::vector<ImageEdge>& found) {
  near.for_each(scene.wedges, index, light, make, [&](const NearPiece& piece, auto&, const auto&, auto inside) {
    EdgePieces pieces(scene.wedges, frequencies, request, [&](std::span<const double> list) { return make(piece.look, list); });
    pieces.add(index, inside);
    const Complex factor = std::polar(1.0, -wavenumber(frequencies[request.frequency_index]) * piece.path);
    for (ImageEdge& part : pieces.take()) found.push_back({part.begin, part.end, part.s *= factor});
  });
}

}  // namespace

EdgeLookResult fringe_scattering_near(const EdgeScene& scene, const AntennaPair& antennas, std::span<const double> frequencies,
                                      const FringeOptions& options, const SurfaceLight& surfaces) {
  assert(!frequencies.empty() && options.order >= 1);
  LitEdges light = light_of(scene, antennas, frequencies, options);
  NearSum sum(antennas, frequencies, scene.tracer.mesh().radius, options.order > 1);
  EdgeLookResult result = at_order(scene, options, [&](auto make) {
    for (std::uint32_t index = 0; index < scene.wedges.size(); ++index) sum.add(scene.wedges, index, light, make);
    return sum.take();
  });
  const NearLook near(antennas, wavenumber(std::ranges::max(frequencies)), scene.tracer.mesh().radius);
  for (const SurfaceArrival& arrival : surfaces.arrivals)
    result.work += add_arrivals(scene, near.at(arrival.position), frequencies, options,
                                {std::span(&arrival, 1), surfaces.frequencies}, result.higher);
  for_corner_waves_near(scene, antennas, frequencies, light, [&](std::uint32_t index, auto lit, const auto& visits) {
    result.work += work::edge_light + work::corner_wave;
    scene.corners->add(index, lit_share(lit), visits, frequencies, result.higher);
  });
  return result;
}

std::vector<ImageEdge> fringe_pieces_near(const EdgeScene& scene, const AntennaPair& antennas,
                                          std::span<const double> frequencies, const PieceRequest& request,
                                          const FringeOptions& options) {
  LitEdges light = light_of(scene, antennas, frequencies, options);
  NearEdges near(antennas, frequencies, scene.tracer.mesh().radius);
  std::vector<ImageEdge> found;
  at_order(scene, options, [&](auto make) {
    for (std::uint32_t index = 0; index < scene.wedges.size(); ++index)
      add_pieces(scene, index, near, light, frequencies, request, make, found);
  });
  for_corner_waves_near(scene, antennas, frequencies, light, [&](std::uint32_t index, auto lit, const auto& visits) {
    for (const LitInterval& part : cut_at_cells(scene.wedges[index], lit, request.lattice)) {
      ScatteringMatrix s;
      scene.corners->add(index, part.end - part.begin, visits, frequencies.subspan(request.frequency_index, 1), {&s, 1});
      found.push_back({point_on(scene.wedges[index], part.begin), point_on(scene.wedges[index], part.end), s});
    }
  });
  return found;
}

}  // namespace raytube
