#include "utd/interaction/pair_price.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "utd/interaction/edge_illumination.h"
#include "utd/interaction/pair_reach.h"

namespace raytube {

namespace {

constexpr double edges_asked = 8.0, rays_asked = 128.0;
// Measured on a car of 2 464 triangles, a tracked carrier, two trucks, a bulldozer and the body of a dump truck.
constexpr double price_in_the_open = 1e6, price_of_rows = 0.3;

// Rows that arrive at faces, of rays about an edge that a wave lights from the middle of the space around it.
double rows_about(const InteractionScene& scene, const EdgeAxis& axis, double wavenumber, double rays) {
  const WedgeFace& face = axis.wedge->faces[0];
  const double free = axis.wedge->n * pi;
  const dvec3 to_source = std::cos(0.5 * free) * face.into_face + std::sin(0.5 * free) * face.normal;
  const PlaneWave wave{-to_source, {axis.tangent, glm::cross(axis.tangent, to_source)}};
  LookVectors look{};
  look.incident = wave.direction, look.scattered = to_source;
  look.electric = look.receive = wave.electric;
  const LitEdgePiece piece{&axis, &wave, incidence_on(*axis.wedge, wave.direction).faces[0], 0.0, axis.length};
  const std::vector<double> wavenumbers{wavenumber};
  EdgeIllumination illumination(scene.faces, look, wavenumbers, piece, most_reflections);
  double rows = 0.0;
  for (double i = 0.0; i < rays; ++i) rows += static_cast<double>(illumination.rows(free * (i + 0.5) / rays));
  return rows;
}

}  // namespace

double price_of_pair(const InteractionScene& scene, double wavenumber) {
  std::vector<double> lengths;
  for (const EdgeAxis& axis : scene.axes) lengths.push_back(axis.length);
  if (lengths.empty()) return 0.0;
  std::ranges::sort(lengths, std::greater{});
  const std::size_t count = with_equals(lengths, edges_asked);
  const double least = lengths[count - 1] * (1.0 - equally_strong);
  const double rays = std::max(1.0, std::floor(rays_asked / static_cast<double>(count)));
  double rows = 0.0;
  for (const EdgeAxis& axis : scene.axes)
    if (axis.length >= least) rows += rows_about(scene, axis, wavenumber, rays);
  const double mean = rows / (rays * static_cast<double>(count));
  return price_in_the_open * std::exp2(std::round(std::log2(1.0 + price_of_rows * mean * mean)));
}

}  // namespace raytube
