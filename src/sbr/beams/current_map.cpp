#include "sbr/beams/current_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sbr/beams/polygon_integral.h"

namespace raytube {

namespace {

TubeMiddle middle_of(const Footprint& footprint, const dvec2& at) {
  const Beam& beam = footprint.outgoing;
  const dvec2 step = at - beam.anchor;
  return {at, beam.base + step.x * beam.along_u + step.y * beam.along_v,
          footprint.phase + footprint.phase_u * step.x + footprint.phase_v * step.y};
}

}  // namespace

ImageLattice image_lattice(const LaunchGrid& grid) {
  return {grid.u_hat, grid.v_hat, {grid.u_begin, grid.v_begin}, {grid.du, grid.dv}, grid.columns, grid.rows, grid.curvature};
}

void CurrentMap::Parts::add(const dvec2& at, std::uint32_t triangle, const ScatteringMatrix& s) {
  map_.add(bounce_, at, triangle, s);
  rest_ = rest_ - s;
  if (const double size = largest_amplitude(s); size > most_) most_ = size, strongest_ = at, triangle_ = triangle;
}

CurrentMap::CurrentMap(const FaceTree& faces, const ImageLattice& lattice, std::size_t frequency_index, double wavenumber,
                       CurrentSink sink, bool shallow, const std::optional<double>& mirror)
    : faces_(faces),
      lattice_(lattice),
      frequency_index_(frequency_index),
      wavenumber_(wavenumber),
      sink_(std::move(sink)),
      shallow_(shallow),
      mirror_(mirror) {}

void CurrentMap::add(int bounce, const dvec2& at, std::uint32_t triangle, const ScatteringMatrix& s) {
  sink_({at, place_on(triangle, at), s, bounce, triangle});
}

void CurrentMap::add(int bounce, const TubeMiddle& middle, std::uint32_t triangle, const ScatteringMatrix& s) {
  sink_({middle.at, place_of(middle), s, bounce, triangle});
}

void CurrentMap::add(int bounce, const Footprint& footprint, const Bounds& tube, std::uint32_t triangle) {
  cut_up(tube, [&](const Bounds& part) {
    const dvec2 at = middle(part), size = part.high - part.low;
    ScatteringMatrix s;
    add_far_field(s, footprint, frequency_index_, wavenumber_, phase_integral(footprint, wavenumber_, at, size.x, size.y));
    add(bounce, middle_of(footprint, at), triangle, s);
  });
}

void CurrentMap::add(int bounce, const Footprint& footprint, const ConvexPolygon& outline, std::uint32_t face) {
  const std::span<const std::uint32_t> triangles = faces_.triangles(face);
  for (const std::uint32_t triangle : triangles) {
    clipped_ = outline;
    if (triangles.size() > 1 && !clip_to(corners(footprint.outgoing, triangle), outline)) continue;
    cut_up(clipped_, [&](const ConvexPolygon& part) {
      shallow_ ? tell(bounce, footprint, part, triangle) : tell_slice(bounce, footprint, part, triangle);
    });
  }
}

// A surface that the look does not see square on reflects to elsewhere: its pieces cancel but for its sides, and do so at other
// frequencies and angles as well only if the phase hardly turns across each. They are slices across its gradient.
void CurrentMap::tell(int bounce, const Footprint& footprint, const ConvexPolygon& part, std::uint32_t triangle) {
  constexpr double most_slices = 1024.0, slices_to_a_turn = 8.0;
  const Affine path{0.0, footprint.phase_u, footprint.phase_v};
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Corner& corner : part) least = std::min(least, path(corner.at)), most = std::max(most, path(corner.at));
  const double slices = std::clamp(std::ceil(slices_to_a_turn * (most - least) * wavenumber_ / (2.0 * pi)), 1.0, most_slices);
  ConvexPolygon left = part, slice, beyond;
  for (double i = 1.0; i < slices && !left.empty(); ++i) {
    cut(left, {-(least + (most - least) * i / slices), path.u, path.v}, 0.0, beyond, slice);
    std::swap(left, beyond);
    if (!slice.empty()) tell_slice(bounce, footprint, slice, triangle);
  }
  if (!left.empty()) tell_slice(bounce, footprint, left, triangle);
}

void CurrentMap::tell_slice(int bounce, const Footprint& footprint, const ConvexPolygon& slice, std::uint32_t triangle) {
  ScatteringMatrix s;
  add_far_field(s, footprint, frequency_index_, wavenumber_, phase_integral(footprint, wavenumber_, slice));
  add(bounce, middle_of(footprint, middle(slice)), triangle, s);
}

// The mirror makes r of r - 2 (r_z - z) z_hat, and the path longer by 2 z cos(theta).
dvec3 CurrentMap::place_of(const TubeMiddle& middle) const {
  const dvec3 towards = glm::cross(lattice_.u_hat, lattice_.v_hat);
  const double path = middle.path + (mirror_ ? 2.0 * *mirror_ * towards.z : 0.0);
  dvec3 last = middle.point;
  if (mirror_) last.z = 2.0 * *mirror_ - last.z;
  const dvec2 across = 0.5 * (middle.at + lattice_.project(last));
  return 0.5 * path * towards + across.x * lattice_.u_hat + across.y * lattice_.v_hat;
}

// On its plane, seen from the radar.
dvec3 CurrentMap::place_on(std::uint32_t triangle, const dvec2& at) const {
  const TriangleMesh& mesh = faces_.mesh();
  const auto& [a, b, c] = mesh.triangles[triangle];
  const dvec3 normal = glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]),
              towards = glm::cross(lattice_.u_hat, lattice_.v_hat), across = at.x * lattice_.u_hat + at.y * lattice_.v_hat;
  const double facing = glm::dot(normal, towards);
  dvec3 place = facing == 0.0 ? across : across + glm::dot(normal, mesh.vertices[a] - across) / facing * towards;
  if (mirror_) place.z = *mirror_;
  return place;
}

// In launch coordinates.
std::array<dvec2, 3> CurrentMap::corners(const Beam& beam, std::uint32_t triangle) const {
  std::array<dvec2, 3> projected;
  for (int c = 0; c < 3; ++c)
    projected[c] = launch_coordinates(beam, faces_.mesh().vertices[faces_.mesh().triangles[triangle][c]]);
  return projected;
}

// Fills clipped_; false if nothing is left.
bool CurrentMap::clip_to(const std::array<dvec2, 3>& corners, const ConvexPolygon& outline) {
  const auto& [a, b, c] = corners;
  if (!Bounds{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))}.overlaps(bounds(outline), 0.0)) return false;
  set_corners(triangle_, corners);
  clipped_ = intersection(outline, triangle_);
  return !clipped_.empty();
}

}  // namespace raytube
