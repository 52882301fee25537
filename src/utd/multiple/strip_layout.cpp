#include "utd/multiple/strip_layout.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// The soft current is singular at its edge: a strip next to a corner, hardly longer than nothing, hands on the more the shorter
// it is: beside a corner that is integrable, but where rounding leaves a strip no length at all it knew no bound. What starts
// there lies the closer to the next edge the smaller its sine delta, and S grew as 1 / root(delta). So strips shorter than 1e-8 /
// k, of which rounding has left nothing, pass no soft current on, and where a wave of the tree runs along an edge, delta below
// 0.1, those up to 1 / (30 k) pass less on; that length grows from the shorter one at delta = 0.1, so that nothing jumps.
double fading_length_of(const WaveTree& tree) {
  constexpr double alongside = 0.1;
  double sine = alongside;
  for (const TreeWave& wave : tree.waves().subspan(1)) sine = std::min(sine, wave.wave.incidence.sin_cone);
  const double cone = tree.waves()[0].wave.incidence.sin_cone;
  return std::max(1e-8 * cone * cone, 1.0 / 30 * (1 - sine / alongside) * (1 - sine / alongside));
}

// Waves on both sides of half planes, over the same strips.
bool have_same_kernels(const WaveTree& tree, const TreeWave& a, const TreeWave& b) {
  const auto grazes_half_plane = [&](const TreeWave& each) {
    return tree.starts_at_half_plane(each) && !tree.runs_over_curved(each.wave);
  };
  const auto bundles = [&](const TreeWave& of) {
    return tree.bundles().subspan(of.first_bundle, of.end_bundle - of.first_bundle);
  };
  const auto are_same = [](const StripBundle& x, const StripBundle& y) {
    return !x.edge == !y.edge && x.from == y.from && x.to == y.to && x.length == y.length && x.growth == y.growth;
  };
  return a.wave.wedge == b.wave.wedge && grazes_half_plane(a) && grazes_half_plane(b) && a.wave.direction == b.wave.direction &&
         std::ranges::equal(bundles(a), bundles(b), are_same);
}

void find_faces(const StripScene& scene, StripLayout& strips) {
  strips.faces.clear();
  const TreeWave* before = nullptr;
  for (const TreeWave& each : strips.tree.waves()) {
    const StripWave& wave = each.wave;
    const Wedge& wedge = scene.wedges[wave.source];
    const double half_cosine = grazing_half_cosine(wave.across, wave.incidence, scene.look.scattered);
    strips.faces.push_back({Strip(wedge.n, wave.incidence, half_cosine),
                            {},
                            face_projection(wave, scene.look),
                            0,
                            before != nullptr && have_same_kernels(strips.tree, *before, each)});
    if (wedge.thickness() > 0.0)
      strips.faces.back().thin.emplace(wedge, wave.source_face, wave.incidence, half_cosine, scene.look.scattered, each.direct);
    before = &each;
  }
}

// Strips between edges that are parallel to 1e-13 of their length share their kernels.
bool are_alike(const TreeWave& wave, const StripBundle& bundle) {
  const double growth = std::max({std::abs(bundle.growth), std::abs(wave.behind.growth), std::abs(wave.detour.growth)});
  return !bundle.edge || growth * (bundle.to - bundle.from) < 1e-13 * bundle.length_at(bundle.from);
}

// Amplitudes of the first strips are those of the points; of those that follow they are what arrived with the bundle before.
// Mirrored ones have those of the strips they continue.
std::size_t first_amplitude(const StripLayout& strips, const TreeWave& wave, const EdgePanels::PointRange& points) {
  if (wave.parent == no_index) return points.first;
  const StripRow& before = strips.rows[wave.parent];
  const std::size_t skipped = points.first - strips.panels.ranges()[wave.parent].first;
  return (wave.wave.mirrors > 0 ? before.amplitude : before.arriving) + skipped;
}

void lay_out_rows(StripLayout& strips) {
  strips.rows.clear();
  strips.arriving = 0;
  for (std::size_t w = 0; w < strips.tree.waves().size(); ++w) {
    const TreeWave& wave = strips.tree.waves()[w];
    std::size_t& kernels = strips.faces[w].kernels;
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const EdgePanels::PointRange& points = strips.panels.ranges()[b];
      const bool alike = are_alike(wave, strips.tree.bundles()[b]);
      strips.rows.push_back({first_amplitude(strips, wave, points), strips.arriving, kernels, points.size(), alike});
      strips.arriving += points.size();
      kernels += alike ? std::min<std::size_t>(points.size(), 1) : points.size();
    }
  }
}

bool has_semi_infinite_strips(const StripLayout& strips, const TreeWave& wave) {
  for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b)
    if (!strips.tree.bundles()[b].edge && strips.rows[b].size > 0) return true;
  return false;
}

std::optional<ForwardPole> forward_pole(const StripScene& scene, const StripLayout& strips) {
  const TreeWave& first = strips.tree.waves()[0];
  if (!has_semi_infinite_strips(strips, first)) return std::nullopt;
  const FaceIncidence& incidence = first.wave.incidence;
  const Wedge& wedge = scene.wedges[first.wave.wedge];
  const WedgeFace& face = wedge.faces[first.wave.face];
  const ForwardPole result{split_kernels(wedge.n, incidence, grazing_half_cosine(face, incidence, scene.look.scattered)),
                           face.width};
  return result.kernels.active ? std::optional(result) : std::nullopt;
}

}  // namespace

FaceProjection face_projection(const StripWave& wave, const LookVectors& look) {
  FaceProjection result;
  for (int receive = 0; receive < 2; ++receive) {
    const double across = glm::dot(look.receive[receive], wave.across);
    const double along = glm::dot(look.receive[receive], wave.incidence.tangent) / wave.incidence.sin_cone;
    result.across[receive] = wave.sign * across / (2 * pi * wave.incidence.sin_cone);
    result.along[receive] = wave.sign * along / (2 * pi * wave.incidence.sin_cone);
  }
  return result;
}

// The soft current flows along the edge; what arrives of it at the end of a strip is its component along that, of the part of the
// wave whose E lies in the face. The rest is in the plane of incidence: where it grazes, its current is that which the hard waves
// from the other edges take away again, so that passing it on would count it twice.
IncidentFields incident_fields(const StripScene& scene, const StripWave& first) {
  const LookVectors& look = scene.look;
  const FaceIncidence& incidence = first.incidence;
  const dvec3 across = glm::cross(scene.wedges[first.wedge].faces[first.face].normal, look.incident);
  const double squared = glm::dot(across, across);
  const double share = squared > 0.0 ? glm::dot(across, incidence.tangent) * incidence.cos_cone / squared : 0.0;
  const double weight = scene.wedges[first.wedge].share;
  IncidentFields result;
  for (int transmit = 0; transmit < 2; ++transmit) {
    result.magnetic[transmit] = weight * glm::dot(look.magnetic[transmit], incidence.tangent);
    result.electric[transmit] = weight * glm::dot(look.electric[transmit], incidence.tangent);
    result.lying[transmit] = weight * glm::dot(look.electric[transmit], across) * share;
  }
  return result;
}

void lay_out(const StripScene& scene, const StripWave& wave, StripLayout& strips) {
  strips.fading_length = fading_length_of(strips.tree);
  find_faces(scene, strips);
  lay_out_rows(strips);
  strips.incident = incident_fields(scene, wave);
  strips.forward_pole = forward_pole(scene, strips);
}

}  // namespace raytube
