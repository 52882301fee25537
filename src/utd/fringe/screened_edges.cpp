#include "utd/fringe/screened_edges.h"

#include <map>
#include <utility>

#include "utd/fringe/corner_pass.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// Of one wedge.
struct LitParts {
  std::uint32_t wedge;
  std::vector<LitInterval> lit;  // in order
};

// Parts of edges by the screens they stand behind.
class ScreenedParts {
 public:
  explicit ScreenedParts(const ScreenCutter& cutter) : cutter_(cutter) {}

  void add(const Wedge& wedge, std::uint32_t index, const LitInterval& lit) {
    parts_.clear();
    cutter_.cut(wedge, lit, parts_);
    for (ScreenedInterval& part : parts_) {
      std::vector<LitParts>& group = groups_[std::move(part.screens)];
      if (group.empty() || group.back().wedge != index) group.push_back({index, {}});
      group.back().lit.push_back(part.lit);
    }
  }

  const std::map<Screens, std::vector<LitParts>>& groups() const { return groups_; }

 private:
  const ScreenCutter& cutter_;
  std::vector<ScreenedInterval> parts_;
  std::map<Screens, std::vector<LitParts>> groups_;
};

ScreenCutter cutter_of(const OpaqueAndScreens& target, const Look& look, double wavelength) {
  const dvec3 transmitter = spherical_basis(look.transmit).radial, receiver = spherical_basis(look.receive).radial;
  return {target, transmitter, receiver == transmitter ? std::nullopt : std::optional(Viewpoint(receiver)), wavelength};
}

// Edges behind screens in one look; `make` is that of at_order().
template <class Make>
class ScreenedLook {
 public:
  ScreenedLook(const EdgeScene& scene, const Look& look, const SweepSubset& subset, bool receiver_shadow, Make make)
      : scene_(scene),
        look_(look),
        vectors_(look_vectors(look)),
        subset_(subset),
        make_(make),
        cutter_(cutter_of(*scene.screens, look, shortest_wavelength(subset.frequencies))),
        parts_(cutter_),
        waves_(cutter_) {
    find_parts(receiver_shadow);
  }
  ScreenedLook(const ScreenedLook&) = delete;

  EdgeLookResult sum() const {
    EdgeLookResult sum;
    sum.scattering.resize(subset_.frequencies.size()), sum.windowed.resize(subset_.frequencies.size());
    sum.wedges_lit = wedges_lit_;
    for (const auto& [screens, group] : parts_.groups()) {
      auto edges = make_(vectors_, subset_.frequencies);
      for (const LitParts& part : group) edges.add(part.wedge, *edges.meeting(part.wedge), part.lit);
      add_through(screens, edges.take(), sum);
    }
    for (const auto& [screens, group] : waves_.groups()) {
      EdgeLookResult waves;
      waves.scattering.resize(sum.scattering.size()), waves.higher.resize(sum.scattering.size());
      waves.windowed.resize(sum.scattering.size());
      for (const LitParts& part : group) {
        sum.work += work::corner_wave;
        scene_.corners->add(part.wedge, lit_share(part.lit), vectors_, subset_.frequencies, waves.higher);
      }
      add_through(screens, std::move(waves), sum);
    }
    return sum;
  }

  std::vector<ImageEdge> pieces(const PieceRequest& request) const {
    std::vector<ImageEdge> all;
    const auto make = [&](std::span<const double> frequencies) { return make_(vectors_, frequencies); };
    for (const auto& [screens, group] : parts_.groups()) {
      EdgePieces pieces(scene_.wedges, subset_.frequencies, request, make);
      for (const LitParts& part : group) pieces.add(part.wedge, part.lit);
      add_through(screens, pieces.take(), request, all);
    }
    for (const auto& [screens, group] : waves_.groups()) {
      std::vector<ImageEdge> pieces;
      for (const LitParts& part : group)
        add_wave_pieces(scene_, part.wedge, part.lit, vectors_, subset_.frequencies[request.frequency_index], request, pieces);
      add_through(screens, std::move(pieces), request, all);
    }
    return all;
  }

 private:
  Passage passage(const Screens& screens, std::size_t frequency) const {
    return {*scene_.screens, screens, {subset_, frequency}, spherical_basis(look_.transmit), spherical_basis(look_.receive)};
  }

  void find_parts(bool receiver_shadow) {
    LitEdges light(scene_.wedges, scene_.tracer, vectors_, shortest_wavelength(subset_.frequencies), receiver_shadow);
    const auto edges = make_(vectors_, subset_.frequencies);
    for (std::uint32_t index = 0; index < scene_.wedges.size(); ++index) {
      const auto meeting = edges.meeting(index);
      if (!meeting || !light.find(index, meeting->incidence)) continue;
      ++wedges_lit_;
      for (const LitInterval& lit : light.lit()) parts_.add(scene_.wedges[index], index, lit);
    }
    const auto incident = [&](const Wedge&) { return vectors_.incident; };
    for_edges_between_corners(scene_, light, incident, [&](std::uint32_t index, std::span<const LitInterval> lit) {
      for (const LitInterval& part : lit) waves_.add(scene_.wedges[index], index, part);
    });
  }

  void add_through(const Screens& screens, std::vector<ImageEdge> pieces, const PieceRequest& request,
                   std::vector<ImageEdge>& all) const {
    const Passage by = passage(screens, request.frequency_index);
    for (ImageEdge& piece : pieces) {
      by.transform(piece.s);
      all.push_back(piece);
    }
  }

  void add_through(const Screens& screens, EdgeLookResult part, EdgeLookResult& sum) const {
    sum.higher.resize(part.higher.size());
    sum.work += part.work;
    for (std::size_t f = 0; f < subset_.frequencies.size(); ++f) {
      const Passage by = passage(screens, f);
      by.transform(part.scattering[f]);
      sum.scattering[f] += part.scattering[f];
      if (part.windowed[f]) sum.windowed[f] = true;
      if (part.higher.empty()) continue;
      by.transform(part.higher[f]);
      sum.higher[f] += part.higher[f];
    }
    sum.lit = sum.lit || part.lit;
  }

  const EdgeScene& scene_;
  const Look& look_;
  LookVectors vectors_;
  const SweepSubset& subset_;
  Make make_;
  ScreenCutter cutter_;
  ScreenedParts parts_, waves_;  // of strips, and of waves from corner to corner
  std::uint64_t wedges_lit_ = 0;
};

}  // namespace

EdgeLookResult screened_fringe_scattering(const EdgeScene& scene, const Look& look, const SweepSubset& subset,
                                          const FringeOptions& options) {
  return at_order(scene, options,
                  [&](auto make) { return ScreenedLook(scene, look, subset, options.receiver_shadow, make).sum(); });
}

std::vector<ImageEdge> screened_fringe_pieces(const EdgeScene& scene, const Look& look, const SweepSubset& subset,
                                              const PieceRequest& request, const FringeOptions& options) {
  return at_order(scene, options,
                  [&](auto make) { return ScreenedLook(scene, look, subset, options.receiver_shadow, make).pieces(request); });
}

}  // namespace raytube
