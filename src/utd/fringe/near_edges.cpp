#include "utd/fringe/near_edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "scene/frequency_bands.h"
#include "utd/fringe/corner_pass.h"
#include "utd/fringe/near_pieces.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

/// Lit parts of an edge by the screens they stand behind.
using PartsByScreens = std::map<Screens, std::vector<LitInterval>>;

/// The screens of a scene before points of its edges.
class NearScreens {
 public:
  NearScreens(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset)
      : target_(scene.screens), antennas_(antennas), subset_(subset) {
    const auto view = [](const Antenna& antenna) { return Viewpoint::at(antenna.position()); };
    std::optional<Viewpoint> receiver;
    if (antennas.receive.position() != antennas.transmit.position()) receiver = view(antennas.receive);
    if (target_) cutter_.emplace(*target_, view(antennas.transmit), receiver, shortest_wavelength(subset.frequencies));
  }

  std::vector<ScreenedInterval> parts_of(const Wedge& wedge, std::span<const LitInterval> lit) const {
    std::vector<ScreenedInterval> parts;
    for (const LitInterval& part : lit)
      if (cutter_)
        cutter_->cut(wedge, part, parts);
      else
        parts.push_back({part, {}});
    return parts;
  }

  /// What is S of a point without screens becomes that behind these, at one of the frequencies.
  void transform(ScatteringMatrix& s, const Screens& screens, const dvec3& point, std::size_t frequency) const {
    if (screens == Screens()) return;
    Passage(*target_, screens, {subset_, frequency}, antennas_.transmit.basis_at(point), antennas_.receive.basis_at(point))
        .transform(s);
  }

 private:
  const OpaqueAndScreens* target_;
  const AntennaPair& antennas_;
  SweepSubset subset_;
  std::optional<ScreenCutter> cutter_;
};

/// The lit pieces of edges in one look from a finite distance.
class NearEdges {
 public:
  NearEdges(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset)
      : frequencies_(subset.frequencies),
        materials_(scene.materials),
        screens_(scene, antennas, subset),
        cutter_(near_antennas(antennas), wavenumber(sampling_frequency(frequencies_)), scene.tracer.mesh().radius) {}

  /// Calls visit(piece, edges, meeting, lit, screens) for those of wedge `index`, `edges` made by `make`, that of at_order().
  template <class Make, class Visit>
  void for_each(std::span<const Wedge> wedges, std::uint32_t index, LitEdges& light, Make make, Visit visit) {
    const Wedge& wedge = wedges[index];
    if (!wedge.radiates() && (materials_ == nullptr || !materials_->radiates(wedge))) return;
    pieces_.clear();
    cutter_.cut(wedge, 0.0, 1.0, pieces_);
    bool searched = false;
    for (const NearPiece& piece : pieces_) {
      auto edges = make(piece.look, frequencies_);
      const auto meeting = edges.meeting(index);
      if (!meeting) continue;
      if (!searched && !light.find(index, meeting->incidence)) break;
      if (!searched) parts_ = screens_.parts_of(wedge, light.lit());
      searched = true;
      bool first = true;
      for (const auto& [screens, inside] : inside_of(piece)) {
        if (first) {
          visit(piece, edges, *meeting, std::span<const LitInterval>(inside), screens);
        } else {
          auto more = make(piece.look, frequencies_);
          visit(piece, more, *meeting, std::span<const LitInterval>(inside), screens);
        }
        first = false;
      }
    }
  }

  const NearScreens& screens() const { return screens_; }

 private:
  PartsByScreens inside_of(const NearPiece& piece) const {
    PartsByScreens inside;
    for (const auto& [lit, screens] : parts_) {
      const double begin = std::max(lit.begin, piece.begin), end = std::min(lit.end, piece.end);
      if (begin < end) inside[screens].push_back({begin, end});
    }
    return inside;
  }

  std::span<const double> frequencies_;
  const EdgeMaterials* materials_;
  NearScreens screens_;
  PieceCutter cutter_;
  std::vector<NearPiece> pieces_;
  std::vector<ScreenedInterval> parts_;  // of the wedge
};

/// Adds edge after edge, piece after piece.
class NearSum {
 public:
  NearSum(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset, bool higher)
      : frequencies_(subset.frequencies), near_(scene, antennas, subset) {
    sum_.scattering.resize(frequencies_.size());
    if (higher) sum_.higher.resize(frequencies_.size());
    sum_.windowed.resize(frequencies_.size());
  }

  template <class Make>
  void add(std::span<const Wedge> wedges, std::uint32_t index, LitEdges& light, Make make) {
    bool lit = false;
    const auto visit = [&](const NearPiece& piece, auto& edges, const auto& meeting, auto inside, const Screens& screens) {
      edges.add(index, meeting, inside);
      EdgeLookResult part = edges.take();
      add(part, piece, screens);
      sum_.lit = sum_.lit || part.lit;
      sum_.work += part.work;
      lit = lit || part.wedges_lit > 0;
    };
    near_.for_each(wedges, index, light, make, visit);
    if (lit) ++sum_.wedges_lit;
  }

  EdgeLookResult take() { return std::move(sum_); }

 private:
  void add(EdgeLookResult& part, const NearPiece& piece, const Screens& screens) {
    const auto add_to = [&](ScatteringMatrix& sum, ScatteringMatrix& s, std::size_t i) {
      near_.screens().transform(s, screens, piece.middle, i);
      add_product(sum, s, std::polar(1.0, -wavenumber(frequencies_[i]) * piece.path));
    };
    for (std::size_t i = 0; i < frequencies_.size(); ++i) {
      add_to(sum_.scattering[i], part.scattering[i], i);
      if (!part.higher.empty()) add_to(sum_.higher[i], part.higher[i], i);
      if (part.windowed[i]) sum_.windowed[i] = true;
    }
  }

  std::span<const double> frequencies_;
  NearEdges near_;
  EdgeLookResult sum_;
};

/// Waves from corner to corner; those of the antennas are plane at each corner.
class NearCornerWaves {
 public:
  NearCornerWaves(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset)
      : scene_(scene),
        antennas_(antennas),
        screens_(scene, antennas, subset),
        near_(near_antennas(antennas), wavenumber(sampling_frequency(subset.frequencies)), scene.tracer.mesh().radius) {}

  /// Calls add(index, lit, visits, screens) for the edges that have any.
  template <class Add>
  void for_each(LitEdges& light, Add add) const {
    const auto incident = [&](const Wedge& wedge) { return near_.at(middle_of(wedge)).incident; };
    for_edges_between_corners(scene_, light, incident, [&](std::uint32_t index, std::span<const LitInterval> lit) {
      PartsByScreens parts;
      for (auto& [part, screens] : screens_.parts_of(scene_.wedges[index], lit)) parts[screens].push_back(part);
      const std::array<dvec3, 2> corners = scene_.corners->corners_of(index);
      for (const auto& [screens, part] : parts)
        add(index, std::span<const LitInterval>(part), std::array{visit(corners[0]), visit(corners[1])}, screens);
    });
  }

  /// Behind the screens as they are at the edge's middle.
  void transform(ScatteringMatrix& s, const Screens& screens, std::uint32_t index, std::size_t frequency) const {
    screens_.transform(s, screens, middle_of(scene_.wedges[index]), frequency);
  }

 private:
  static dvec3 middle_of(const Wedge& wedge) { return 0.5 * (wedge.start + wedge.end); }

  CornerWaves::Visit visit(const dvec3& corner) const {
    return {near_.at(corner), -antennas_.transmit.ray_to(corner).path, -antennas_.receive.ray_to(corner).path};
  }

  const EdgeScene& scene_;
  const AntennaPair& antennas_;
  NearScreens screens_;
  NearLook near_;
};

LitEdges light_of(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset, const FringeOptions& options) {
  std::optional<Viewpoint> receiver;
  if (options.receiver_shadow) receiver = Viewpoint::at(antennas.receive.position());
  const Viewpoint transmitter = Viewpoint::at(antennas.transmit.position());
  return LitEdges(scene.wedges, scene.tracer, transmitter, receiver, shortest_wavelength(subset.frequencies));
}

/// The pieces of one edge that is lit, but for its corner waves.
template <class Make>
void add_pieces(const EdgeScene& scene, std::uint32_t index, NearEdges& near, LitEdges& light,
                std::span<const double> frequencies, const PieceRequest& request, Make make, std::vector<ImageEdge>& found) {
  const auto visit = [&](const NearPiece& piece, auto&, const auto&, auto inside, const Screens& screens) {
    EdgePieces pieces(scene.wedges, frequencies, request, [&](std::span<const double> list) { return make(piece.look, list); });
    pieces.add(index, inside);
    const Complex factor = std::polar(1.0, -wavenumber(frequencies[request.frequency_index]) * piece.path);
    for (ImageEdge& part : pieces.take()) {
      near.screens().transform(part.s, screens, piece.middle, request.frequency_index);
      found.push_back({part.begin, part.end, part.s *= factor});
    }
  };
  near.for_each(scene.wedges, index, light, make, visit);
}

/// The waves of one edge in the look's sum. Without screens they are added one by one.
void add_corner_waves(const CornerWaves& corners, std::uint32_t index, double share,
                      const std::array<CornerWaves::Visit, 2>& visits, const Screens& screens, const NearCornerWaves& near,
                      std::span<const double> frequencies, std::vector<ScatteringMatrix>& sum) {
  if (screens == Screens()) return corners.add(index, share, visits, frequencies, sum);
  std::vector<ScatteringMatrix> waves(frequencies.size());
  corners.add(index, share, visits, frequencies, waves);
  for (std::size_t f = 0; f < waves.size(); ++f) {
    near.transform(waves[f], screens, index, f);
    sum[f] += waves[f];
  }
}

}  // namespace

EdgeLookResult fringe_scattering_near(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset,
                                      const FringeOptions& options, const SurfaceLight& surfaces) {
  assert(!subset.frequencies.empty() && options.order >= 1);
  LitEdges light = light_of(scene, antennas, subset, options);
  NearSum sum(scene, antennas, subset, options.order > 1);
  EdgeLookResult result = at_order(scene, options, [&](auto make) {
    for (std::uint32_t index = 0; index < scene.wedges.size(); ++index) sum.add(scene.wedges, index, light, make);
    return sum.take();
  });
  const NearLook near(near_antennas(antennas), wavenumber(sampling_frequency(subset.frequencies)), scene.tracer.mesh().radius);
  for (const SurfaceArrival& arrival : surfaces.arrivals)
    result.work += add_arrivals(scene, near.at(arrival.position), subset.frequencies, options,
                                {std::span(&arrival, 1), surfaces.frequencies}, result.higher);
  const NearCornerWaves waves(scene, antennas, subset);
  waves.for_each(light, [&](std::uint32_t index, auto lit, const auto& visits, const Screens& screens) {
    result.work += work::edge_light + work::corner_wave;
    add_corner_waves(*scene.corners, index, lit_share(lit), visits, screens, waves, subset.frequencies, result.higher);
  });
  return result;
}

std::vector<ImageEdge> fringe_pieces_near(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset,
                                          const PieceRequest& request, const FringeOptions& options) {
  LitEdges light = light_of(scene, antennas, subset, options);
  NearEdges near(scene, antennas, subset);
  std::vector<ImageEdge> found;
  at_order(scene, options, [&](auto make) {
    for (std::uint32_t index = 0; index < scene.wedges.size(); ++index)
      add_pieces(scene, index, near, light, subset.frequencies, request, make, found);
  });
  const NearCornerWaves waves(scene, antennas, subset);
  waves.for_each(light, [&](std::uint32_t index, auto lit, const auto& visits, const Screens& screens) {
    for (const LitInterval& part : cut_at_cells(scene.wedges[index], lit, request.lattice)) {
      ScatteringMatrix s;
      scene.corners->add(index, part.end - part.begin, visits, subset.frequencies.subspan(request.frequency_index, 1), {&s, 1});
      waves.transform(s, screens, index, request.frequency_index);
      found.push_back({point_on(scene.wedges[index], part.begin), point_on(scene.wedges[index], part.end), s});
    }
  });
  return found;
}

}  // namespace raytube
