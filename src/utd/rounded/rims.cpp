#include "utd/rounded/rims.h"

#include <cmath>
#include <map>

#include "scene/frequency_bands.h"
#include "utd/rounded/nose_table.h"
#include "utd/rounded/rounded_edge.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// The wedge between the tangents; its virtual apex is the origin.
Wedge wedge_of(const Nose& nose, const ConicSection& section, double scale) {
  const dvec3 across = glm::cross(nose.along, nose.outwards);
  const double s = std::sin(section.end), c = std::cos(section.end), width = scale * section.tangent_distance();
  const auto face = [&](double side) {
    return WedgeFace{no_index, -s * nose.outwards + side * c * across, c * nose.outwards + side * s * across, width};
  };
  return {dvec3(0.0), nose.along, 2.0 - section.interior_angle() / pi, {face(-1.0), face(1.0)}};
}

ScatteringMatrix amplitude_of(const Nose& nose, const NoseNode& node, const LookVectors& look, double wavenumber, double across) {
  const double scale = 1.0 / across;
  const Wedge wedge = wedge_of(nose, node.section, scale);
  const RoundedEdge edge{wedge, {scale * node.section.radius, node.section.flattening, node.section.end}};
  ScatteringMatrix s = rounded_edge_amplitude(edge, node.modes, incidence_on(wedge, look.incident), look, wavenumber);
  const double path = edge.section.apex() * glm::dot(look.scattered - look.incident, nose.outwards);
  return s *= std::polar(1.0, wavenumber * path);
}

// S per unit length, phases from the nose.
ScatteringMatrix nose_amplitude(const Nose& nose, const LookVectors& look, double wavenumber) {
  ScatteringMatrix sum;
  const double sines = std::sqrt(nose.sine_to(look.incident) * nose.sine_to(look.scattered));
  if (sines < 1e-3) return sum;
  const double across = wavenumber * sines, radius = across * nose.radius;
  for (const NosePlace& place : nose_places(radius, nose.flattening)) {
    if (place.node == nullptr) continue;
    ScatteringMatrix s = amplitude_of(nose, *place.node, look, wavenumber, across);
    sum += s *= place.weight;
  }
  return sum;
}

// Bends that are too round for an edge at this wavenumber have no section to share among their facets, though a facet may
// be sharp enough by itself: lower frequencies of the sweep have found them. A facet whose normals turn against its section is
// no part of a bend, and would take its place in a mean the wrong way round.
bool is_edge(const Nose& nose, double wavenumber) {
  return nose.radius > 0.0 && wavenumber * nose.radius < edge_radius && nose.turn > 0.0 && nose.facet_share(wavenumber) > 0.0;
}

}  // namespace

double longest_nose(double frequency) { return wavelength(sampled_band(frequency).highest) / 4; }

// Pieces are a twentieth of the wavelength long. Directions of unit length whose mean is shorter than a half have no mean.
std::vector<RimPiece> rim_pieces(std::span<const Nose> noses, double wavenumber) {
  const double cell = 1.0 / 20 * 2 * pi / wavenumber;
  std::map<std::array<long, 6>, RimPiece> cells;
  for (const Nose& nose : noses) {
    if (!is_edge(nose, wavenumber)) continue;
    const double length = nose.evenness * nose.turn * nose.facet_share(wavenumber) / nose.shared_turn(wavenumber);
    std::array<long, 6> key{};
    for (int i = 0; i < 3; ++i) key[i] = std::lround(nose.position[i] / cell), key[3 + i] = std::lround(nose.outwards[i]);
    RimPiece& piece = cells[key];
    if (glm::dot(piece.nose.along, nose.along) < 0.0) piece.nose.along = -piece.nose.along;
    piece.length += length;
    piece.nose.position += length * nose.position;
    piece.nose.outwards += length * nose.outwards;
    piece.nose.along += length * nose.along;
    piece.nose.radius += length * nose.radius;
    piece.nose.flattening += length * nose.flattening;
    piece.nose.bend += length * nose.bend;
  }
  std::vector<RimPiece> pieces;
  for (auto& [key, piece] : cells) {
    if (piece.length <= 0.0) continue;
    Nose& nose = piece.nose;
    const double most = glm::length(nose.outwards), least = 0.5 * piece.length;
    if (!(most > least)) continue;
    nose.position /= piece.length;
    nose.outwards /= most;
    nose.along -= glm::dot(nose.along, nose.outwards) * nose.outwards;
    if (!(glm::length(nose.along) > least)) continue;
    nose.along = glm::normalize(nose.along);
    nose.radius /= piece.length;
    nose.flattening /= piece.length;
    nose.bend /= piece.length;
    pieces.push_back(piece);
  }
  return pieces;
}

CountedSum rim_scattering(const CurvedTarget& target, std::span<const RimPiece> pieces, LocalLook& look, double wavenumber,
                          StripPlaces* places) {
  CountedSum sum;
  for (const RimPiece& piece : pieces) {
    const dvec3& position = piece.nose.position;
    const LookVectors& here = look.at(position);
    const double bent = std::sqrt(piece.nose.straightness(here.incident) * piece.nose.straightness(here.scattered)),
                 share = bent * piece.nose.edge_share(here.incident, here.scattered, wavenumber);
    if (share <= 0.0 || !target.is_lit(position, piece.nose.outwards, here.incident)) continue;
    ScatteringMatrix s = nose_amplitude(piece.nose, here, wavenumber);
    s *= std::polar(piece.length * share, wavenumber * look.both(position));
    sum.s += s;
    sum.count(1, work::rim_piece);
    if (places != nullptr) places->pieces.push_back({position, position, s});
  }
  return sum;
}

}  // namespace raytube
