#include "sbr/beams/current_map.h"

#include <algorithm>

#include "sbr/beams/polygon_integral.h"

namespace raytube {

namespace {

double turn(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

// How far inside a triangle a point is, by its barycentric coordinates; negative outside.
double depth_inside(const std::array<dvec2, 3>& corners, const dvec2& at) {
  const double area = turn(corners[1] - corners[0], corners[2] - corners[0]);
  double least = 1.0;
  for (int c = 0; c < 3; ++c) least = std::min(least, turn(corners[(c + 1) % 3] - corners[c], at - corners[c]) / area);
  return least;
}

}  // namespace

ImageLattice image_lattice(const LaunchGrid& grid) {
  return {grid.u_hat, grid.v_hat, {grid.u_begin, grid.v_begin}, {grid.du, grid.dv}, grid.columns, grid.rows};
}

CurrentMap::CurrentMap(const FaceTree& faces, const ImageLattice& lattice, std::size_t frequency_index, double wavenumber)
    : faces_(faces),
      lattice_(lattice),
      frequency_index_(frequency_index),
      wavenumber_(wavenumber),
      cells_(lattice.cells()),
      triangles_(faces.mesh().triangles.size()) {}

void CurrentMap::add(const dvec2& at, std::uint32_t triangle, const ScatteringMatrix& s) {
  cells_[lattice_.index(lattice_.at(at))] += s;
  triangles_[triangle] += s;
}

void CurrentMap::add(const Footprint& footprint, const Bounds& tube, std::uint32_t triangle) {
  cut_up(tube, [&](const Bounds& part) {
    const dvec2 at = middle(part), size = part.high - part.low;
    ScatteringMatrix s;
    add_far_field(s, footprint, frequency_index_, wavenumber_, phase_integral(footprint, wavenumber_, at, size.x, size.y));
    add(at, triangle, s);
  });
}

void CurrentMap::add(const Footprint& footprint, const ConvexPolygon& outline, std::uint32_t face) {
  const std::span<const std::uint32_t> triangles = faces_.triangles(face);
  for (const std::uint32_t triangle : triangles) {
    clipped_ = outline;
    if (triangles.size() > 1 && !clip_to(corners(footprint, triangle), outline)) continue;
    add_far_field(triangles_[triangle], footprint, frequency_index_, wavenumber_,
                  phase_integral(footprint, wavenumber_, clipped_));
    cut_up(clipped_, [&](const ConvexPolygon& part) {
      add_far_field(cells_[lattice_.index(lattice_.at(middle(part)))], footprint, frequency_index_, wavenumber_,
                    phase_integral(footprint, wavenumber_, part));
    });
  }
}

std::uint32_t CurrentMap::triangle_under(const Footprint& footprint, std::uint32_t face, const dvec2& at) const {
  return *std::ranges::max_element(faces_.triangles(face), {},
                                   [&](std::uint32_t triangle) { return depth_inside(corners(footprint, triangle), at); });
}

// In launch coordinates.
std::array<dvec2, 3> CurrentMap::corners(const Footprint& footprint, std::uint32_t triangle) const {
  std::array<dvec2, 3> projected;
  for (int c = 0; c < 3; ++c)
    projected[c] = launch_coordinates(footprint.outgoing, faces_.mesh().vertices[faces_.mesh().triangles[triangle][c]]);
  return projected;
}

// Fills clipped_; false if nothing is left.
bool CurrentMap::clip_to(const std::array<dvec2, 3>& corners, const ConvexPolygon& outline) {
  set_corners(triangle_, corners);
  clipped_ = outline;
  if (!bounds(triangle_).overlaps(bounds(outline), 0.0)) return false;
  for (const Corner& corner : triangle_) {
    cut(clipped_, corner.edge, 0.0, inside_, outside_);
    std::swap(clipped_, inside_);
    if (clipped_.empty()) return false;
  }
  return true;
}

}  // namespace raytube
