#include "sbr/curved/curved_piece.h"

#include <algorithm>
#include <cmath>

#include "sbr/curved/curved_rule.h"
#include "sbr/curved/curved_weights.h"

namespace raytube {

CurvedPiece::CurvedPiece(const LaunchGrid& grid, const LocalSurface& surface, std::uint32_t material, bool from_behind)
    : surface_(surface), material_(material), from_behind_(from_behind) {
  const dvec3 from_plane = surface.point - grid.plane_origin;
  anchor_ = {glm::dot(from_plane, grid.u_hat), glm::dot(from_plane, grid.v_hat)};
  const glm::dmat3 frame(grid.u_hat, grid.v_hat, grid.direction);
  normal_ = glm::transpose(frame) * surface.normal;
  curve_ = glm::transpose(frame) * surface.curvature * frame;
  // Depth t over the launch point w: a t^2 + b t + c = 0 with the coefficients of depth(); b^2 - 4 a c collected in w.
  const dvec2 tilt(curve_[2]);
  const double a = -0.5 * curve_[2][2];
  shadow_boundary_.c = normal_.z * normal_.z;
  shadow_boundary_.g = -2.0 * normal_.z * tilt - 4.0 * a * dvec2(normal_);
  shadow_boundary_.m = glm::outerProduct(tilt, tilt) + 2.0 * a * glm::dmat2(curve_);
}

CurvedPiece::Depth CurvedPiece::depth(const dvec2& from_anchor) const {
  const dvec3 w(from_anchor, 0.0), curved = curve_ * w;
  const double a = -0.5 * curve_[2][2], b = normal_.z - curved.z, c = glm::dot(normal_, w) - 0.5 * glm::dot(w, curved);
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant <= 0.0) return {a == 0.0 ? 0.0 : -0.5 * b / a, 0.0, 0.0};
  const double root = std::sqrt(discriminant), depth = -2.0 * c / (b - root);
  const dvec3 gradient = normal_ - curve_ * dvec3(from_anchor, depth);
  return {depth, gradient.x / root, gradient.y / root};
}

double CurvedPiece::distance(const dvec3& point) const {
  const dvec3 x = point - surface_.point, curved = surface_.curvature * x;
  return std::abs(glm::dot(surface_.normal, x) - 0.5 * glm::dot(x, curved)) / glm::length(surface_.normal - curved);
}

namespace {

// The integrals of 1 and of the depth's slopes times the phase factor, of all frequencies.
class Moments {
 public:
  Moments(const Illumination& light, const CurvedPiece& piece)
      : light_(light), piece_(piece), sums_(light.surfaces.wavenumbers.size()) {
    change_ = light.receive.radial - light.grid.direction;
    along_ = {glm::dot(change_, light.grid.u_hat), glm::dot(change_, light.grid.v_hat), glm::dot(change_, light.grid.direction)};
  }

  double path(const dvec2& at) const { return path(at, piece_.depth(at).depth); }

  void add(const dvec2& at, double weight) {
    const CurvedPiece::Depth here = piece_.depth(at);
    const double length = path(at, here.depth);
    for (std::size_t f = 0; f < sums_.size(); ++f) {
      const Complex value = std::polar(weight, light_.surfaces.wavenumbers[f] * length);
      sums_[f].one += value;
      sums_[f].slope_u += here.slope_u * value;
      sums_[f].slope_v += here.slope_v * value;
    }
  }

  std::vector<ScatteringMatrix> far_field() const {
    const LaunchGrid& grid = light_.grid;
    const std::array<dvec3, 2> incident{light_.transmit.theta_hat, light_.transmit.phi_hat},
        received{light_.receive.theta_hat, light_.receive.phi_hat};
    const double start = glm::dot(change_, piece_.surface().point);
    std::vector<ScatteringMatrix> scattering(sums_.size());
    for (std::size_t f = 0; f < sums_.size(); ++f) {
      const double k = light_.surfaces.wavenumbers[f];
      const Complex factor = Complex(0.0, -k / (2.0 * pi)) * std::polar(1.0, k * start);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) {
          const double forward = glm::dot(received[p], grid.direction);
          scattering[f].at(p, q) = factor * (glm::dot(received[p], incident[q]) * sums_[f].one +
                                             forward * (glm::dot(incident[q], grid.u_hat) * sums_[f].slope_u +
                                                        glm::dot(incident[q], grid.v_hat) * sums_[f].slope_v));
        }
    }
    return scattering;
  }

 private:
  // Exponent / k, counted from the anchor.
  double path(const dvec2& at, double depth) const { return along_.x * at.x + along_.y * at.y + along_.z * depth; }

  struct Sum {
    Complex one, slope_u, slope_v;
  };
  const Illumination& light_;
  const CurvedPiece& piece_;
  dvec3 change_, along_;
  std::vector<Sum> sums_;
};

Bounds from_anchor(const CurvedPiece& piece, const Bounds& cell) {
  return {cell.low - piece.anchor(), cell.high - piece.anchor()};
}

struct Ranges {
  dvec2 along{0.0};    // along u and along v, the larger of three rows
  double whole = 0.0;  // over all nine points
};

Ranges path_ranges(const Moments& moments, const Bounds& cell) {
  double path[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) path[i][j] = moments.path(cell.low + (cell.high - cell.low) * dvec2(0.5 * i, 0.5 * j));
  Ranges ranges;
  double low = path[0][0], high = low;
  for (int i = 0; i < 3; ++i) {
    const auto [u_low, u_high] = std::minmax({path[0][i], path[1][i], path[2][i]});
    const auto [v_low, v_high] = std::minmax({path[i][0], path[i][1], path[i][2]});
    ranges.along = glm::max(ranges.along, dvec2(u_high - u_low, v_high - v_low));
    low = std::min(low, u_low);
    high = std::max(high, u_high);
  }
  ranges.whole = high - low;
  return ranges;
}

}  // namespace

double path_range(const Illumination& light, const CurvedPiece& piece, const Bounds& cell) {
  return path_ranges(Moments(light, piece), from_anchor(piece, cell)).whole;
}

std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const Bounds& cell,
                                               TubeSums* sums) {
  if (piece.material() != no_index) return curved_weights_far_field(light, piece, cell, sums);
  const Bounds box = from_anchor(piece, cell);
  Moments moments(light, piece);
  const dvec2 phase = std::ranges::max(light.surfaces.wavenumbers) * path_ranges(moments, box).along;
  // Chords run along the steeper axis, so that most of them cross the limb and do not touch it.
  const int axis = phase.x > phase.y ? 0 : 1, across = 1 - axis;
  std::vector<double> ends = breaks(piece.limb(), axis, box.low[axis], box.high[axis], box.low[across], box.high[across]);
  const bool at_shadow_boundary = !ends.empty();
  ends.push_back(box.high[across]);
  double begin = box.low[across];
  for (const double end : ends) {
    for_points(begin, end, at_shadow_boundary, phase[across], [&](double row, double row_weight) {
      const Chord part = chord(piece.limb(), axis, row, box.low[axis], box.high[axis]);
      if (part.low == part.high) return;
      for_points(part.low, part.high, part.cut, phase[axis],
                 [&](double x, double weight) { moments.add(axis == 0 ? dvec2(x, row) : dvec2(row, x), row_weight * weight); });
    });
    begin = end;
  }
  return moments.far_field();
}

std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const ConvexPolygon& polygon,
                                               TubeSums* sums) {
  if (piece.material() != no_index) return curved_weights_far_field(light, piece, polygon, sums);
  Moments moments(light, piece);
  const dvec2 origin = polygon[0].at - piece.anchor();
  double low = moments.path(origin), high = low;
  for (const Corner& corner : polygon) {
    const double path = moments.path(corner.at - piece.anchor());
    low = std::min(low, path);
    high = std::max(high, path);
  }
  const auto rule = gauss_rule(points_for(std::ranges::max(light.surfaces.wavenumbers) * (high - low)) - 1);
  // Triangles of a fan, each a square collapsed to a corner (Duffy 1982).
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const dvec2 a = polygon[i - 1].at - polygon[0].at, b = polygon[i].at - polygon[0].at;
    const double twice_area = a.x * b.y - a.y * b.x;
    for (const GaussPoint& x : rule)
      for (const GaussPoint& y : rule)
        if (const dvec2 at = origin + x.place * (a + y.place * (b - a)); piece.limb()(at) > 0.0)
          moments.add(at, twice_area * x.weight * x.place * y.weight);
  }
  return moments.far_field();
}

}  // namespace raytube
