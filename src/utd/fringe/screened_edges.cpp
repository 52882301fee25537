#include "utd/fringe/screened_edges.h"

#include <map>
#include <utility>

#include "core/work.h"
#include "utd/fringe/corner_pass.h"

namespace raytube {

namespace {

// The mesh with its patches, of the triangles that `take` says.
template <class Take>
TriangleMesh part_of(const TriangleMesh& mesh, Take take) {
  TriangleMesh part = mesh;
  part.triangles.clear(), part.triangle_patch.clear(), part.triangle_component.clear();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!take(mesh.patches[mesh.triangle_patch[t]].material)) continue;
    part.triangles.push_back(mesh.triangles[t]);
    part.triangle_patch.push_back(mesh.triangle_patch[t]);
    part.triangle_component.push_back(mesh.triangle_component[t]);
  }
  return part;
}

// The screens before the transmitter and before the receiver.
using Screens = std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>;

// What comes through them, at one frequency.
struct Passage {
  ChannelWeights transmit, receive;
};

ChannelWeights product(const ChannelWeights& a, const ChannelWeights& b) {
  ChannelWeights c;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  return c;
}

// One of the frequencies of a sweep.
struct SweepFrequency {
  std::size_t index;  // in the sweep
  double wavenumber;

  SweepFrequency(const SweepSubset& subset, std::size_t i)
      : index(subset.indices[i]), wavenumber(raytube::wavenumber(subset.frequencies[i])) {}
};

ChannelWeights through(const OpaqueAndScreens& target, std::span<const std::uint32_t> screens, const SweepFrequency& at,
                       const SphericalBasis& antenna) {
  ChannelWeights all{{{1.0, 0.0}, {0.0, 1.0}}};
  for (const std::uint32_t patch : screens)
    all = product(through_screen(target.material(patch), at.index, at.wavenumber, target.normal(patch), antenna), all);
  return all;
}

void transform(ScatteringMatrix& s, const Passage& by) {
  const ScatteringMatrix bare = std::exchange(s, {});
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) s.at(p, q) += by.receive[p][i] * bare.at(i, j) * by.transmit[q][j];
}

// Of one wedge.
struct LitParts {
  std::uint32_t wedge;
  std::vector<LitInterval> lit;  // in order
};

// Parts of edges by the screens they stand behind.
class ScreenedParts {
 public:
  ScreenedParts(const OpaqueAndScreens& target, const Look& look, double wavelength)
      : target_(target),
        transmitter_(spherical_basis(look.transmit).radial),
        receiver_(spherical_basis(look.receive).radial),
        wavelength_(wavelength) {}

  void add(const Wedge& wedge, std::uint32_t index, const LitInterval& lit) {
    const double length = (lit.end - lit.begin) * wedge.length();
    const int steps = static_cast<int>(std::clamp(std::ceil(2.0 * length / wavelength_), 8.0, 128.0));
    // Ends touch other faces: tested a little inside.
    const auto fraction = [&](int i) {
      return lit.begin + (lit.end - lit.begin) * std::clamp(i / double(steps), 1e-6, 1.0 - 1e-6);
    };
    double begin = lit.begin, low = fraction(0);
    Screens screens = at(wedge, low);
    for (int i = 1; i <= steps;) {
      Screens next = at(wedge, fraction(i));
      if (next == screens) {
        low = fraction(i++);
        continue;
      }
      const double change = bisect(wedge, screens, low, fraction(i));
      put(index, {begin, change}, std::move(screens));
      begin = low = change;
      screens = at(wedge, std::min(change + beside, fraction(i)));
    }
    put(index, {begin, lit.end}, std::move(screens));
  }

  const std::map<Screens, std::vector<LitParts>>& groups() const { return groups_; }

 private:
  static constexpr double beside = 1e-9;

  Screens at(const Wedge& wedge, double fraction) const {
    const dvec3 point = glm::mix(wedge.start, wedge.end, fraction);
    std::vector<std::uint32_t> before = target_.before(point, transmitter_);
    return {before, receiver_ == transmitter_ ? before : target_.before(point, receiver_)};
  }

  // Where these screens end between a point that has them and one that has not.
  double bisect(const Wedge& wedge, const Screens& screens, double low, double high) const {
    while (high - low > beside) {
      const double middle = 0.5 * (low + high);
      (at(wedge, middle) == screens ? low : high) = middle;
    }
    return high;
  }

  void put(std::uint32_t index, const LitInterval& part, Screens screens) {
    std::vector<LitParts>& group = groups_[std::move(screens)];
    if (group.empty() || group.back().wedge != index) group.push_back({index, {}});
    group.back().lit.push_back(part);
  }

  const OpaqueAndScreens& target_;
  dvec3 transmitter_, receiver_;
  double wavelength_;
  std::map<Screens, std::vector<LitParts>> groups_;
};

Passage passage(const OpaqueAndScreens& target, const Screens& screens, const Look& look, const SweepFrequency& at) {
  return {through(target, screens.first, at, spherical_basis(look.transmit)),
          through(target, screens.second, at, spherical_basis(look.receive))};
}

// Edges behind screens in one look; `make` is that of at_order().
template <class Make>
class ScreenedLook {
 public:
  ScreenedLook(const EdgeScene& scene, const OpaqueAndScreens& target, const Look& look, const SweepSubset& subset,
               bool receiver_shadow, Make make)
      : scene_(scene),
        target_(target),
        look_(look),
        vectors_(look_vectors(look)),
        subset_(subset),
        make_(make),
        parts_(target, look, shortest_wavelength(subset.frequencies)),
        waves_(target, look, shortest_wavelength(subset.frequencies)) {
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
    const Passage by = passage(target_, screens, look_, {subset_, request.frequency_index});
    for (ImageEdge& piece : pieces) {
      transform(piece.s, by);
      all.push_back(piece);
    }
  }

  void add_through(const Screens& screens, EdgeLookResult part, EdgeLookResult& sum) const {
    sum.higher.resize(part.higher.size());
    for (std::size_t f = 0; f < subset_.frequencies.size(); ++f) {
      const Passage by = passage(target_, screens, look_, {subset_, f});
      transform(part.scattering[f], by);
      sum.scattering[f] += part.scattering[f];
      if (part.windowed[f]) sum.windowed[f] = true;
      if (part.higher.empty()) continue;
      transform(part.higher[f], by);
      sum.higher[f] += part.higher[f];
    }
    sum.lit = sum.lit || part.lit;
  }

  const EdgeScene& scene_;
  const OpaqueAndScreens& target_;
  const Look& look_;
  LookVectors vectors_;
  const SweepSubset& subset_;
  Make make_;
  ScreenedParts parts_, waves_;  // of strips, and of waves from corner to corner
  std::uint64_t wedges_lit_ = 0;
};

}  // namespace

OpaqueAndScreens::OpaqueAndScreens(const TriangleMesh& mesh, std::span<const Material> materials)
    : opaque_mesh_(part_of(mesh, [&](std::uint32_t m) { return m == no_index || !materials[m].transmits(); })),
      screen_mesh_(part_of(mesh, [&](std::uint32_t m) { return m != no_index && materials[m].transmits(); })),
      opaque_(opaque_mesh_),
      screens_(screen_mesh_),
      materials_(materials) {}

std::vector<std::uint32_t> OpaqueAndScreens::before(const dvec3& point, const dvec3& direction) const {
  std::vector<std::uint32_t> patches;
  Ray ray{point, direction};
  for (Hit hit;; patches.push_back(ray.source_patch)) {
    screens_.closest_hits({&ray, 1}, {&hit, 1});
    if (!hit) return patches;
    ray = {ray.origin + hit.distance * direction, direction, screen_mesh_.triangle_patch[hit.triangle]};
  }
}

EdgeLookResult screened_fringe_scattering(const EdgeScene& scene, const OpaqueAndScreens& target, const Look& look,
                                          const SweepSubset& subset, const FringeOptions& options) {
  return at_order(scene, options,
                  [&](auto make) { return ScreenedLook(scene, target, look, subset, options.receiver_shadow, make).sum(); });
}

std::vector<ImageEdge> screened_fringe_pieces(const EdgeScene& scene, const OpaqueAndScreens& target, const Look& look,
                                              const SweepSubset& subset, const PieceRequest& request,
                                              const FringeOptions& options) {
  return at_order(scene, options, [&](auto make) {
    return ScreenedLook(scene, target, look, subset, options.receiver_shadow, make).pieces(request);
  });
}

}  // namespace raytube
