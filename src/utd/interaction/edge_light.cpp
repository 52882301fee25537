#include "utd/interaction/edge_light.h"

#include <algorithm>

#include "scene/frequency_bands.h"
#include "utd/shadow/lit_edges.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

LookVectors look_from(const NearAntennas& antennas, const dvec3& point) {
  const AntennaRay in = antennas.transmit.ray_to(point), out = antennas.receive->ray_to(point);
  return look_of({in.direction, in.field}, {{}, -out.direction, {}, {}, out.field});
}

}  // namespace

EdgeLight::EdgeLight(const InteractionScene& of, const Look& a_look, std::span<const double> frequencies,
                     const NearAntennas* antennas)
    : scene(of),
      look(antennas ? look_from(*antennas, dvec3(0.0)) : look_vectors(a_look)),
      incident{look.incident, look.electric, 0.0},
      wavelength(raytube::wavelength(sampling_frequency(frequencies))) {
  for (const double frequency : frequencies) wavenumbers.push_back(wavenumber(frequency));
  if (antennas) incident.antennas = *antennas;
  find_direct();
  find_reflected();
  for (const LitEdgePiece& piece : direct) jobs.push_back({&piece, most_reflections, nullptr});
  for (const ReflectedWave& wave : reflected)
    for (const LitEdgePiece& piece : wave.lit)
      jobs.push_back({&piece, most_reflections - static_cast<int>(wave.patches.size()), &wave});
}

std::uint32_t EdgeLight::wedge_of(const EdgeAxis& axis) const {
  return static_cast<std::uint32_t>(axis.wedge - scene.edges.wedges.data());
}

void EdgeLight::find_direct() {
  const Viewpoint transmitter =
      incident.antennas ? Viewpoint::at(incident.antennas->transmit.position()) : Viewpoint(-look.incident);
  LitEdges edges(scene.edges.wedges, scene.edges.tracer, transmitter, std::nullopt, wavelength);
  for (std::size_t i = 0; i < scene.axes.size(); ++i) {
    const EdgeAxis& axis = scene.axes[i];
    if (axis.length < scene.shortest_axis || !scene.plan.has(i)) continue;
    work += work::edge_light;
    const dvec3 middle = axis.origin + 0.5 * axis.length * axis.tangent;
    const WedgeIncidence incidence = incidence_on(*axis.wedge, incident.about(middle).direction);
    const double weight = incidence_weight(*axis.wedge, incidence);
    if (weight == 0.0 || !edges.find(wedge_of(axis), incidence)) continue;
    for (const LitInterval& lit : edges.lit()) {
      const double from = axis.reversed() ? 1.0 - lit.end : lit.begin, to = axis.reversed() ? 1.0 - lit.begin : lit.end;
      direct.push_back({&axis, &incident, incidence.faces[0], from * axis.length, to * axis.length, weight});
    }
  }
}

void EdgeLight::find_reflected() {
  ReflectedLight light(scene.faces, scene.axes, incident, wavelength, scene.shortest_axis, scene.plan);
  reflected = light.waves(most_reflections);
  if (scene.faces.materials.any())
    for (ReflectedWave& wave : reflected) weigh_by_surfaces(wave);
  work += light.work();
  pairs_left_out = light.pairs_left_out();
}

// A wave from an antenna at a finite distance has the weights of the middle of each piece that it lights.
void EdgeLight::weigh_by_surfaces(ReflectedWave& wave) const {
  std::vector<MetFace> mirrors;
  for (const std::uint32_t patch : wave.patches) mirrors.emplace_back(scene.faces.tree.mesh().patches[patch]);
  if (std::ranges::all_of(mirrors, [](const MetFace& face) { return face.material == no_index; })) return;
  for (LitEdgePiece& piece : wave.lit) {
    const PlaneWave here = wave.wave.about(piece.edge->origin + 0.5 * (piece.from + piece.to) * piece.edge->tangent);
    for (std::size_t f = 0; f < wavenumbers.size(); ++f)
      piece.by_surfaces.push_back(
          weights_after(scene.faces.materials, mirrors, here.direction, here.electric, f, wavenumbers[f]));
  }
}

PathPlace EdgeLight::place_of(std::span<const std::uint32_t> mirrors) const {
  PathPlace place{look.scattered};
  for (const std::uint32_t patch : mirrors) {
    const Patch& plane = scene.faces.tree.mesh().patches[patch];
    place.add_mirror(plane.normal, plane.offset);
  }
  return place;
}

PathPlace EdgeLight::place_of(const LitJob& job) const {
  return job.reflected ? place_of(job.reflected->patches) : place_of(std::span<const std::uint32_t>{});
}

std::vector<ReflectedLook> EdgeLight::looks_of(const ReflectedWave& wave, std::span<const LitEdgePiece> pieces) const {
  std::vector<ReflectedLook> looks;
  for (const LitEdgePiece& piece : pieces)
    for (const PlainPart& part : plain_parts(piece, look, wavenumbers, scene.edges.tracer.mesh().radius)) {
      if (looks.empty() || wave.wave.antennas) looks.push_back({part.look, part.path, {}, piece.by_surfaces});
      looks.back().edges.push_back({wedge_of(*piece.edge), {part.of_wedge}, piece.weight});
    }
  return looks;
}

}  // namespace raytube
