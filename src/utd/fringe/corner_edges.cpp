#include "utd/fringe/corner_edges.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/threads.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

/// One look at the edges of one kind.
class CornerEdges {
 public:
  CornerEdges(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset, const FringeOptions& options)
      : scene_(scene), look_(look), edges_(scene, look, subset, options) {}

  const EdgesInLook& edges() const { return edges_; }

  /// Calls visit(index, part, lit, screens) for the lit parts of wedge `index` behind the same screens; `part` is how much of its
  /// edge the wedge is.
  template <class Visit>
  void for_each(CornerWaveKind kind, Visit visit) {
    for (std::uint32_t index = 0; index < scene_.wedges.size(); ++index) {
      stop_if_cancelled();
      if (scene_.corners->kind(index) != kind) continue;
      std::map<Screens, std::vector<LitInterval>> groups;
      for (const auto& [part, screens] : lit_between_corners(index)) groups[screens].push_back(part);
      const double part = scene_.corners->part(index, incident_on(index));
      for (const auto& [screens, lit] : groups) visit(index, part, lit, screens);
    }
  }

  /// Adds a share of the waves along the edge of a wedge at the frequencies [Hz].
  void add(std::uint32_t index, double share, std::span<const double> frequencies, std::span<ScatteringMatrix> sum) const {
    const std::array<dvec3, 2> corners = scene_.corners->corners_of(index);
    const auto visit = [&](const dvec3& corner) {
      return CornerWaves::Visit{look_.at(corner), look_.arriving(corner), look_.leaving(corner)};
    };
    scene_.corners->add(index, share, {visit(corners[0]), visit(corners[1])}, frequencies, sum);
  }

 private:
  dvec3 incident_on(std::uint32_t index) const { return look_.incident(scene_.wedges[index].at(0.5)); }

  /// An edge that is met exactly along its sheet is seen from the sheet's front.
  WedgeIncidence incidence_from_front(std::uint32_t index) const {
    const dvec3 incident = incident_on(index);
    WedgeIncidence incidence = incidence_on(scene_.wedges[index], incident);
    const dvec3& normal = scene_.wedges[index].faces[0].normal;
    if (incidence.weight < 1.0 && std::abs(glm::dot(incident, normal)) <= lit_threshold) incidence.free_side = normal;
    return incidence;
  }

  std::vector<ScreenedInterval> lit_between_corners(std::uint32_t index) {
    const WedgeIncidence incidence = incidence_from_front(index);
    const SolidEdge* solid = scene_.corners->solid(index);
    if (incidence.weight > 0.0 || solid == nullptr) return edges_.lit_parts(index, incidence);
    const double share = share_between_corners(*solid, incident_on(index));
    const LitInterval part{0.0, share};
    return share > 0.0 ? edges_.behind_screens(index, std::span(&part, 1)) : std::vector<ScreenedInterval>();
  }

  /// The part of an edge of a solid between two dark faces that has waves, as both its corners are seen: as much as is lit of the
  /// edges that meet it there, at the corner of which less is.
  double share_between_corners(const SolidEdge& edge, const dvec3& incident) {
    if (!edge.ends[0].sees(-incident) || !edge.ends[1].sees(-incident)) return 0.0;
    double share = 1.0;
    for (const SolidEnd& end : edge.ends) {
      double most = 0.0;
      for (const std::uint32_t other : end.beside) {
        double lit = 0.0;
        for (const ScreenedInterval& part : edges_.lit_parts(other, incidence_from_front(other)))
          lit += part.lit.end - part.lit.begin;
        most = std::max(most, lit);
      }
      share = std::min(share, most);
    }
    return share;
  }

  const EdgeScene& scene_;
  const EdgeLook& look_;
  EdgesInLook edges_;
};

}  // namespace

CornerWaveSum corner_wave_scattering(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                     const FringeOptions& options, CornerWaveKind kind) {
  CornerWaveSum sum{std::vector<ScatteringMatrix>(subset.frequencies.size())};
  CornerEdges all(scene, look, subset, options);
  struct Wave {
    double share = 0.0;
    dvec3 middle{0.0};
  };
  std::map<std::pair<std::uint32_t, Screens>, Wave> waves;  // by the first wedge of each edge
  all.for_each(kind, [&](std::uint32_t index, double part, std::span<const LitInterval> lit, const Screens& screens) {
    Wave& wave =
        waves.try_emplace({scene.corners->first_of(index), screens}, Wave{0.0, scene.wedges[index].at(0.5)}).first->second;
    wave.share += share_of(lit) * part;
  });
  for (const auto& [key, wave] : waves) {
    if (wave.share == 0.0) continue;
    ++sum.edges, sum.work += work::corner_wave;
    std::vector<ScatteringMatrix> s(subset.frequencies.size());
    all.add(key.first, wave.share, subset.frequencies, s);
    for (std::size_t f = 0; f < s.size(); ++f) sum.scattering[f] += all.edges().behind(key.second, wave.middle, s[f], f);
  }
  sum.work += all.edges().work();
  return sum;
}

// Between corners a wave loses as much with the length of the edge as the two ends radiate more, so that its share of S hangs on
// the wavelength alone. Over all looks at boxes, prisms and pyramids of 1 to 20 wavelengths it is at most 0.026 of it times the
// root of the number of edges.
std::vector<double> solid_corner_amplitudes(const EdgeScene& scene, const EdgeLook& look, std::span<const double> frequencies) {
  constexpr double of_one = 0.03;     // wavelengths
  constexpr double alike = 1.0 / 64;  // directions differ by less in each component
  constexpr double off_grid = 0.37;   // so that no direction along an axis lies between two
  struct Way {
    double path;
    const SolidEdge* edge;
  };
  std::map<std::array<long, 3>, std::vector<Way>> ways;  // by direction
  for (std::uint32_t index = 0; index < scene.wedges.size(); ++index) {
    if (scene.corners->kind(index) != CornerWaveKind::solid) continue;
    const std::array<dvec3, 2> corners = scene.corners->corners_of(index);
    const SolidEdge* edge = scene.corners->solid(index);
    for (const int from : {0, 1}) {
      const bool seen =
          edge->ends[from].sees(-look.incident(corners[from])) && edge->ends[1 - from].sees(look.at(corners[1 - from]).scattered);
      if (!seen) continue;
      const dvec3 cell = glm::floor((corners[1 - from] - corners[from]) / (edge->length * alike) + off_grid);
      ways[{std::lround(cell.x), std::lround(cell.y), std::lround(cell.z)}].push_back(
          {look.arriving(corners[from]) + look.leaving(corners[1 - from]) - edge->length, edge});
    }
  }
  std::vector<double> amplitudes;
  for (const double frequency : frequencies) {
    const double k = wavenumber(frequency);
    double squares = 0.0;
    for (const auto& [direction, alike_ways] : ways) {
      Complex sum = 0.0;
      for (const Way& way : alike_ways) sum += std::polar(way.edge->length_weight(k), k * way.path);
      squares += std::norm(sum);
    }
    amplitudes.push_back(of_one * wavelength(frequency) * std::sqrt(squares / 2));
  }
  return amplitudes;
}

std::vector<ImageEdge> corner_wave_pieces(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                          const PieceRequest& request, const FringeOptions& options, CornerWaveKind kind) {
  CornerEdges all(scene, look, subset, options);
  std::vector<ImageEdge> pieces;
  all.for_each(kind, [&](std::uint32_t index, double part, std::span<const LitInterval> lit, const Screens& screens) {
    const Wedge& wedge = scene.wedges[index];
    ScatteringMatrix whole;
    all.add(index, part, subset.frequencies.subspan(request.frequency_index, 1), std::span(&whole, 1));
    whole = all.edges().behind(screens, wedge.at(0.5), whole, request.frequency_index);
    const auto put = [&](const dvec3& begin, const dvec3& end, double share) {
      ScatteringMatrix s = whole;
      pieces.push_back({begin, end, s *= share});
    };
    const dvec3 place = scene.corners->place(index, look.at(wedge.at(0.5)).scattered);
    if (request.by_path) return put(place, place, share_of(lit));
    for (const LitInterval& cell : cut_at_cells(wedge, lit, request.lattice))
      put(wedge.at(cell.begin), wedge.at(cell.end), cell.end - cell.begin);
  });
  return pieces;
}

}  // namespace raytube
