#include "utd/fringe/screens.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr double beside = 1e-9;  // of the length of an edge

// The mesh with its patches, of the triangles that `take` says.
template <class Take>
TriangleMesh part_of(const TriangleMesh& mesh, Take take) {
  TriangleMesh part = mesh;
  part.triangles.clear(), part.triangle_patch.clear(), part.triangle_component.clear();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!take(mesh.patch_of(t).material)) continue;
    part.triangles.push_back(mesh.triangles[t]);
    part.triangle_patch.push_back(mesh.triangle_patch[t]);
    part.triangle_component.push_back(mesh.triangle_component[t]);
  }
  return part;
}

ChannelWeights product(const ChannelWeights& a, const ChannelWeights& b) {
  ChannelWeights c;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  return c;
}

ChannelWeights through(const OpaqueAndScreens& target, std::span<const std::uint32_t> screens, const SweepFrequency& at,
                       const SphericalBasis& antenna) {
  ChannelWeights all{{{1.0, 0.0}, {0.0, 1.0}}};
  for (const std::uint32_t patch : screens)
    all = product(through_screen(target.material(patch), at.index, at.wavenumber, target.normal(patch), antenna), all);
  return all;
}

}  // namespace

OpaqueAndScreens::OpaqueAndScreens(const TriangleMesh& mesh, std::span<const Material> materials)
    : opaque_mesh_(part_of(mesh, [&](std::uint32_t m) { return m == no_index || !materials[m].transmits(); })),
      screen_mesh_(part_of(mesh, [&](std::uint32_t m) { return m != no_index && materials[m].transmits(); })),
      opaque_(opaque_mesh_),
      screens_(screen_mesh_),
      materials_(materials) {}

std::vector<std::uint32_t> OpaqueAndScreens::before(const dvec3& point, const dvec3& direction, std::uint32_t own) const {
  std::vector<std::uint32_t> patches;
  Ray ray{point, direction, own};
  for (Hit hit;; patches.push_back(ray.source_patch)) {
    screens_.closest_hits({&ray, 1}, {&hit, 1});
    if (!hit) return patches;
    ray = {ray.origin + hit.distance * direction, direction, screen_mesh_.triangle_patch[hit.triangle]};
  }
}

void ScreenCutter::cut(const Wedge& wedge, const LitInterval& lit, std::vector<ScreenedInterval>& parts) const {
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
    parts.push_back({{begin, change}, std::move(screens)});
    begin = low = change;
    screens = at(wedge, std::min(change + beside, fraction(i)));
  }
  parts.push_back({{begin, lit.end}, std::move(screens)});
}

Screens ScreenCutter::at(const Wedge& wedge, double fraction) const {
  const dvec3 point = glm::mix(wedge.start, wedge.end, fraction);
  const WedgeFace& face = wedge.faces[0];
  const std::uint32_t own = face.material != no_index && target_.material(face.patch).transmits() ? face.patch : no_index;
  std::vector<std::uint32_t> before = target_.before(point, transmitter_.from(point), own);
  return {before, receiver_ ? target_.before(point, receiver_->from(point), own) : before};
}

// Where these screens end between a point that has them and one that has not.
double ScreenCutter::bisect(const Wedge& wedge, const Screens& screens, double low, double high) const {
  while (high - low > beside) {
    const double middle = 0.5 * (low + high);
    (at(wedge, middle) == screens ? low : high) = middle;
  }
  return high;
}

Passage::Passage(const OpaqueAndScreens& target, const Screens& screens, const SweepFrequency& at, const SphericalBasis& transmit,
                 const SphericalBasis& receive)
    : transmit_(through(target, screens.first, at, transmit)), receive_(through(target, screens.second, at, receive)) {}

void Passage::transform(ScatteringMatrix& s) const {
  const ScatteringMatrix bare = std::exchange(s, {});
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) s.at(p, q) += receive_[p][i] * bare.at(i, j) * transmit_[q][j];
}

}  // namespace raytube
