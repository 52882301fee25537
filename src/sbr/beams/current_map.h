// Where the currents of a look are: on which triangles, and in which cell of the launch rectangle their tubes set out.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/model/face_tree.h"
#include "sbr/beams/footprint.h"
#include "sbr/launch/convex_polygon.h"
#include "sbr/launch/launch.h"
#include "scene/image.h"

namespace raytube {

/// What a current radiates that is no wider than a cell of a map: of a plane wave, back to where it came from.
struct CurrentPiece {
  dvec2 at;  // launch coordinates that its tube set out at, in one cell [m]
  // From where a wave that is reflected once would come back with this phase, and with these changes of it as the direction
  // turns: half of the path, and the middle between where its tube set out and where the current is [m].
  dvec3 place;
  ScatteringMatrix s;
  int bounce;              // counted from 0
  std::uint32_t triangle;  // of the current
};
using CurrentSink = std::function<void(const CurrentPiece&)>;

/// The middle ray of a tube where it meets a surface.
struct TubeMiddle {
  dvec2 at;     // launch coordinates
  dvec3 point;  // on the surface
  double path;  // exponent / k of what the current there radiates [m]
};

/// Tells a sink the far field of every current at one frequency. Whatever is wider than a cell of the lattice is cut along its
/// lines in the launch plane, where the phase is still linear: the parts add up to the whole to rounding. One thread at a time.
class CurrentMap {
 public:
  /// The lattice's coordinates are those of a LaunchGrid; `wavenumber` [rad/m] is that of `frequency_index` in the look.
  /// `shallow`: pieces are no deeper than a fraction of the wavelength either. `mirror`: z of a plane in which the receiver is
  /// the mirror image of the transmitter; the places of pieces are then as that sees them by way of the mirror.
  CurrentMap(const FaceTree& faces, const ImageLattice& lattice, std::size_t frequency_index, double wavenumber, CurrentSink sink,
             bool shallow = false, const std::optional<double>& mirror = {});

  std::size_t frequency_index() const { return frequency_index_; }
  const double& wavenumber() const { return wavenumber_; }

  /// A tube that meets this part of a face, as bounce `bounce`, counted from 0 here and below.
  void add(int bounce, const Footprint& footprint, const ConvexPolygon& outline, std::uint32_t face);
  /// A rectangular tube that meets a triangle.
  void add(int bounce, const Footprint& footprint, const Bounds& tube, std::uint32_t triangle);
  /// The far field `s` of a tube too narrow to be cut, that set out at these launch coordinates and meets this triangle first.
  void add(int bounce, const dvec2& at, std::uint32_t triangle, const ScatteringMatrix& s);
  /// The far field of a narrow tube that may have been reflected before.
  void add(int bounce, const TubeMiddle& middle, std::uint32_t triangle, const ScatteringMatrix& s);

  /// A tube of a spherical wave that meets this part of a face, with its far field; radiated(part) is that of a part of it.
  template <class Radiated>
  void add(int bounce, const Beam& beam, const ConvexPolygon& outline, std::uint32_t face, const ScatteringMatrix& whole,
           Radiated radiated);

  /// A current over a polygon or a box with its far field, part by part: triangle_at(launch coordinates) is where it lies,
  /// radiated(part) the far field of a part. Quadrature over the parts differs from that over the whole by its error: the
  /// strongest part takes that.
  template <class Shape, class TriangleAt, class Radiated>
  void add(int bounce, const Shape& shape, TriangleAt triangle_at, const ScatteringMatrix& whole, Radiated radiated);

 private:
  // Puts down parts of a current, the strongest with what the others leave of the whole.
  class Parts;
  struct Slices {
    ConvexPolygon slice, left, beyond;
  };
  // The line before the i-th column (axis 0) or row (axis 1).
  Affine line(int axis, std::uint32_t i) const {
    return {-(lattice_.corner[axis] + i * lattice_.cell[axis]), axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0};
  }
  template <class Visit>
  void slice(const ConvexPolygon& polygon, int axis, Slices& slices, Visit visit);
  std::array<dvec2, 3> corners(const Beam& beam, std::uint32_t triangle) const;
  template <class Visit>
  void cut_up(const ConvexPolygon& polygon, Visit visit);
  template <class Visit>
  void cut_up(const Bounds& box, Visit visit) const;
  void tell(int bounce, const Footprint& footprint, const ConvexPolygon& part, std::uint32_t triangle);
  void tell_slice(int bounce, const Footprint& footprint, const ConvexPolygon& slice, std::uint32_t triangle);
  dvec3 place_of(const TubeMiddle& middle) const;
  dvec3 place_on(std::uint32_t triangle, const dvec2& at) const;
  bool clip_to(const std::array<dvec2, 3>& corners, const ConvexPolygon& outline);

  const FaceTree& faces_;
  ImageLattice lattice_;
  std::size_t frequency_index_;
  double wavenumber_;
  CurrentSink sink_;
  bool shallow_;
  std::optional<double> mirror_;
  ConvexPolygon triangle_, clipped_;
  Slices rows_, columns_;
};

class CurrentMap::Parts {
 public:
  /// `at`, `triangle`: where the whole is put if there are no parts.
  Parts(CurrentMap& map, int bounce, const ScatteringMatrix& whole, const dvec2& at, std::uint32_t triangle)
      : map_(map), bounce_(bounce), rest_(whole), strongest_(at), triangle_(triangle) {}

  void add(const dvec2& at, std::uint32_t triangle, const ScatteringMatrix& s);
  void finish() { map_.add(bounce_, strongest_, triangle_, rest_); }

 private:
  CurrentMap& map_;
  int bounce_;
  ScatteringMatrix rest_;
  double most_ = -1.0;
  dvec2 strongest_;
  std::uint32_t triangle_;
};

/// The cells of a launch grid.
ImageLattice image_lattice(const LaunchGrid& grid);

template <class Radiated>
void CurrentMap::add(int bounce, const Beam& beam, const ConvexPolygon& outline, std::uint32_t face,
                     const ScatteringMatrix& whole, Radiated radiated) {
  const std::span<const std::uint32_t> triangles = faces_.triangles(face);
  Parts parts(*this, bounce, whole, middle(outline), triangles.front());
  for (const std::uint32_t triangle : triangles) {
    clipped_ = outline;
    if (triangles.size() > 1 && !clip_to(corners(beam, triangle), outline)) continue;
    cut_up(clipped_, [&](const ConvexPolygon& part) { parts.add(middle(part), triangle, radiated(part)); });
  }
  parts.finish();
}

template <class Shape, class TriangleAt, class Radiated>
void CurrentMap::add(int bounce, const Shape& shape, TriangleAt triangle_at, const ScatteringMatrix& whole, Radiated radiated) {
  Parts parts(*this, bounce, whole, middle(shape), triangle_at(middle(shape)));
  cut_up(shape, [&](const Shape& part) { parts.add(middle(part), triangle_at(middle(part)), radiated(part)); });
  parts.finish();
}

template <class Visit>
void CurrentMap::cut_up(const ConvexPolygon& polygon, Visit visit) {
  slice(polygon, 1, rows_, [&](const ConvexPolygon& row) { slice(row, 0, columns_, visit); });
}

template <class Visit>
void CurrentMap::slice(const ConvexPolygon& polygon, int axis, Slices& slices, Visit visit) {
  const Bounds box = bounds(polygon);
  const std::uint32_t last = lattice_.at(box.high)[axis];
  slices.left = polygon;
  for (std::uint32_t i = lattice_.at(box.low)[axis]; i < last && !slices.left.empty(); ++i) {
    cut(slices.left, line(axis, i + 1), 0.0, slices.beyond, slices.slice);
    std::swap(slices.left, slices.beyond);
    if (!slices.slice.empty()) visit(std::as_const(slices.slice));
  }
  if (!slices.left.empty()) visit(std::as_const(slices.left));
}

template <class Visit>
void CurrentMap::cut_up(const Bounds& box, Visit visit) const {
  const glm::uvec2 first = lattice_.at(box.low), last = lattice_.at(box.high);
  for (std::uint32_t row = first.y; row <= last.y; ++row)
    for (std::uint32_t column = first.x; column <= last.x; ++column) {
      Bounds part = box;
      const dvec2 low = lattice_.corner + dvec2(column, row) * lattice_.cell;
      const dvec2 high = lattice_.corner + dvec2(column + 1, row + 1) * lattice_.cell;
      if (column > first.x) part.low.x = low.x;
      if (row > first.y) part.low.y = low.y;
      if (column < last.x) part.high.x = high.x;
      if (row < last.y) part.high.y = high.y;
      visit(std::as_const(part));
    }
}

}  // namespace raytube
