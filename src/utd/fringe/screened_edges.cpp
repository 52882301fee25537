#include "utd/fringe/screened_edges.h"

#include <map>
#include <utility>

#include "utd/fringe/fringe_pieces.h"
#include "utd/shadow/lit_edges.h"

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

// The sheets before the transmitter and before the receiver.
using Screens = std::pair<std::vector<std::uint32_t>, std::vector<std::uint32_t>>;

// What comes through them, at every frequency.
struct Passage {
  ChannelWeights transmit, receive;
};

ChannelWeights product(const ChannelWeights& a, const ChannelWeights& b) {
  ChannelWeights c;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  return c;
}

ChannelWeights through(const OpaqueAndScreens& target, std::span<const std::uint32_t> sheets, std::size_t place, double k,
                       const SphericalBasis& antenna) {
  ChannelWeights all{{{1.0, 0.0}, {0.0, 1.0}}};
  for (const std::uint32_t patch : sheets)
    all = product(through_screen(target.material(patch), place, k, target.normal(patch), antenna), all);
  return all;
}

void transform(ScatteringMatrix& s, const Passage& by) {
  const ScatteringMatrix bare = std::exchange(s, {});
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) s.at(p, q) += by.receive[p][i] * bare.at(i, j) * by.transmit[q][j];
}

// Parts of edges by the sheets they stand behind.
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
    // Ends touch other faces: seen from a little inside.
    const auto place = [&](int i) { return lit.begin + (lit.end - lit.begin) * std::clamp(i / double(steps), 1e-6, 1.0 - 1e-6); };
    double begin = lit.begin, low = place(0);
    Screens screens = at(wedge, low);
    for (int i = 1; i <= steps;) {
      Screens next = at(wedge, place(i));
      if (next == screens) {
        low = place(i++);
        continue;
      }
      const double change = bisect(wedge, screens, low, place(i));
      put(index, {begin, change}, std::move(screens));
      begin = low = change;
      screens = at(wedge, std::min(change + beside, place(i)));
    }
    put(index, {begin, lit.end}, std::move(screens));
  }

  const std::map<Screens, std::vector<LitPieces>>& groups() const { return groups_; }

 private:
  static constexpr double beside = 1e-9;

  Screens at(const Wedge& wedge, double fraction) const {
    const dvec3 point = glm::mix(wedge.start, wedge.end, fraction);
    std::vector<std::uint32_t> before = target_.before(point, transmitter_);
    return {before, receiver_ == transmitter_ ? before : target_.before(point, receiver_)};
  }

  // Where it ends between a place that has it and one that has not.
  double bisect(const Wedge& wedge, const Screens& screens, double low, double high) const {
    while (high - low > beside) {
      const double middle = 0.5 * (low + high);
      (at(wedge, middle) == screens ? low : high) = middle;
    }
    return high;
  }

  void put(std::uint32_t index, const LitInterval& part, Screens screens) {
    std::vector<LitPieces>& group = groups_[std::move(screens)];
    if (group.empty() || group.back().wedge != index) group.push_back({index, {}});
    group.back().lit.push_back(part);
  }

  const OpaqueAndScreens& target_;
  dvec3 transmitter_, receiver_;
  double wavelength_;
  std::map<Screens, std::vector<LitPieces>> groups_;
};

Passage passage(const OpaqueAndScreens& target, const Screens& screens, const Look& look, std::size_t place, double k) {
  return {through(target, screens.first, place, k, spherical_basis(look.transmit)),
          through(target, screens.second, place, k, spherical_basis(look.receive))};
}

void add_through(const Screens& screens, EdgeLookResult part, const OpaqueAndScreens& target, const Look& look,
                 std::span<const double> frequencies, std::span<const std::size_t> places, EdgeLookResult& sum) {
  sum.higher.resize(part.higher.size());
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const Passage by = passage(target, screens, look, places[i], wavenumber(frequencies[i]));
    transform(part.scattering[i], by);
    sum.scattering[i] += part.scattering[i];
    if (part.windowed[i]) sum.windowed[i] = true;
    if (part.higher.empty()) continue;
    transform(part.higher[i], by);
    sum.higher[i] += part.higher[i];
  }
  sum.lit = sum.lit || part.lit;
}

// Returns how many edges there are.
template <class Edges>
std::uint64_t find_parts(std::span<const Wedge> wedges, const Edges& edges, LitEdges& light, ScreenedParts& parts) {
  std::uint64_t lit_edges = 0;
  for (std::uint32_t index = 0; index < wedges.size(); ++index) {
    const auto meeting = edges.meeting(index);
    if (!meeting || !light.find(index, meeting->incidence)) continue;
    ++lit_edges;
    for (const LitInterval& lit : light.lit()) parts.add(wedges[index], index, lit);
  }
  return lit_edges;
}

// `make` makes an FirstOrderEdges or a StripPass.
template <class Make>
EdgeLookResult screened_sum(std::span<const Wedge> wedges, const OpaqueAndScreens& target, const Look& look, LitEdges& light,
                            std::span<const double> frequencies, std::span<const std::size_t> places, Make make) {
  ScreenedParts parts(target, look, shortest_wavelength(frequencies));
  EdgeLookResult sum;
  sum.scattering.resize(frequencies.size()), sum.windowed.resize(frequencies.size());
  sum.wedges_lit = find_parts(wedges, make(frequencies), light, parts);
  for (const auto& [screens, pieces] : parts.groups()) {
    auto pass = make(frequencies);
    for (const LitPieces& piece : pieces) pass.add(piece.wedge, *pass.meeting(piece.wedge), piece.lit);
    add_through(screens, pass.take(), target, look, frequencies, places, sum);
  }
  return sum;
}

template <class Make>
std::vector<ImageEdge> screened_pieces(std::span<const Wedge> wedges, const OpaqueAndScreens& target, const Look& look,
                                       LitEdges& light, std::span<const double> frequencies, std::size_t frequency,
                                       std::size_t place, const ImageLattice& lattice, Make make) {
  ScreenedParts parts(target, look, shortest_wavelength(frequencies));
  find_parts(wedges, make(frequencies), light, parts);
  std::vector<ImageEdge> all;
  for (const auto& [screens, group] : parts.groups()) {
    EdgePieces pieces(wedges, lattice, frequencies, frequency, make);
    for (const LitPieces& piece : group) pieces.add(piece.wedge, piece.lit);
    const Passage by = passage(target, screens, look, place, wavenumber(frequencies[frequency]));
    for (ImageEdge& piece : pieces.take()) {
      transform(piece.s, by);
      all.push_back(piece);
    }
  }
  return all;
}

}  // namespace

OpaqueAndScreens::OpaqueAndScreens(const TriangleMesh& mesh, std::span<const Material> materials)
    : opaque_mesh_(part_of(mesh, [&](std::uint32_t m) { return m == no_index || !materials[m].transmits(); })),
      sheet_mesh_(part_of(mesh, [&](std::uint32_t m) { return m != no_index && materials[m].transmits(); })),
      opaque_(opaque_mesh_),
      sheets_(sheet_mesh_),
      materials_(materials) {}

std::vector<std::uint32_t> OpaqueAndScreens::before(const dvec3& place, const dvec3& direction) const {
  std::vector<std::uint32_t> patches;
  Ray ray{place, direction};
  for (Hit hit;; patches.push_back(ray.source_patch)) {
    sheets_.closest_hits({&ray, 1}, {&hit, 1});
    if (!hit) return patches;
    ray = {ray.origin + hit.distance * direction, direction, sheet_mesh_.triangle_patch[hit.triangle]};
  }
}

EdgeLookResult screened_fringe_scattering(std::span<const Wedge> wedges, const Outlines& outlines, const OpaqueAndScreens& target,
                                          const Look& look, std::span<const double> frequencies,
                                          std::span<const std::size_t> places, int order, bool receiver_shadow,
                                          TransitionTier tier) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(wedges, target.opaque(), vectors, shortest_wavelength(frequencies), receiver_shadow);
  const auto sum = [&](auto make) { return screened_sum(wedges, target, look, light, frequencies, places, make); };
  if (order == 1) return sum([&](std::span<const double> list) { return FirstOrderEdges(wedges, vectors, list); });
  return sum([&](std::span<const double> list) { return StripPass(wedges, outlines, vectors, list, order, tier, false); });
}

std::vector<ImageEdge> screened_fringe_pieces(std::span<const Wedge> wedges, const Outlines& outlines,
                                              const OpaqueAndScreens& target, const Look& look,
                                              std::span<const double> frequencies, std::size_t frequency, std::size_t place,
                                              int order, bool receiver_shadow, TransitionTier tier, const ImageLattice& lattice) {
  const LookVectors vectors = look_vectors(look);
  LitEdges light(wedges, target.opaque(), vectors, shortest_wavelength(frequencies), receiver_shadow);
  const auto pieces = [&](auto make) {
    return screened_pieces(wedges, target, look, light, frequencies, frequency, place, lattice, make);
  };
  if (order == 1) return pieces([&](std::span<const double> list) { return FirstOrderEdges(wedges, vectors, list); });
  return pieces([&](std::span<const double> list) { return StripPass(wedges, outlines, vectors, list, order, tier, false); });
}

}  // namespace raytube
