#include "sbr/curved/curved_weights.h"

#include <algorithm>

#include "sbr/curved/curved_rule.h"

namespace raytube {

namespace {

// The integrals of all four weights.
class Weights {
 public:
  Weights(const Illumination& light, const CurvedPiece& piece, TubeSums* told)
      : light_(light),
        piece_(piece),
        told_(light.surfaces.any_rough() ? told : nullptr),
        change_(light.receive.radial - light.grid.direction),
        arriving_(plain_spectrum({light.transmit.theta_hat, light.transmit.phi_hat}, light.surfaces.wavenumbers.size())),
        sums_(arriving_.size()) {}

  // The normal and the surface per launch area follow from the slopes.
  void add(const dvec2& at, double weight) {
    const LaunchGrid& grid = light_.grid;
    const CurvedPiece::Depth here = piece_.depth(at);
    const dvec3 across = here.slope_u * grid.u_hat + here.slope_v * grid.v_hat - grid.direction;
    const double stretch = glm::length(across), length = path(at, here.depth);
    const Incidence incidence{grid.direction, across / stretch, piece_.material(), piece_.from_behind()};
    const Spectrum waves = leaving_waves(light_.surfaces, incidence, arriving_, light_.receive).reflected;
    if (told_) told_->add_incoherent(waves, weight);
    for (std::size_t f = 0; f < sums_.size(); ++f) {
      const Complex value = std::polar(weight * stretch, light_.surfaces.wavenumbers[f] * length);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) sums_[f].at(p, q) += value * waves[f].weight[p][q];
    }
  }

  double path(const dvec2& at) const { return path(at, piece_.depth(at).depth); }

  std::vector<ScatteringMatrix> far_field() const {
    const double start = glm::dot(change_, piece_.surface().point);
    std::vector<ScatteringMatrix> scattering = sums_;
    for (std::size_t f = 0; f < scattering.size(); ++f) {
      const double k = light_.surfaces.wavenumbers[f];
      scattering[f] *= Complex(0.0, -k / (4.0 * pi)) * std::polar(1.0, k * start);
    }
    return scattering;
  }

 private:
  // Exponent / k, counted from the anchor.
  double path(const dvec2& at, double depth) const {
    const LaunchGrid& grid = light_.grid;
    return glm::dot(change_, at.x * grid.u_hat + at.y * grid.v_hat + depth * grid.direction);
  }

  const Illumination& light_;
  const CurvedPiece& piece_;
  TubeSums* told_;
  dvec3 change_;
  Spectrum arriving_;
  std::vector<ScatteringMatrix> sums_;
};

}  // namespace

std::vector<ScatteringMatrix> curved_weights_far_field(const Illumination& light, const CurvedPiece& piece, const Bounds& cell,
                                                       TubeSums* sums) {
  const dvec2 low = cell.low - piece.anchor(), high = cell.high - piece.anchor();
  Weights weights(light, piece, sums);
  const double phase = std::ranges::max(light.surfaces.wavenumbers) * path_range(light, piece, cell);
  // Chords run along the steeper axis, so that most of them cross the limb and do not touch it.
  const CurvedPiece::Depth middle = piece.depth(0.5 * (low + high));
  const int axis = std::abs(middle.slope_u) > std::abs(middle.slope_v) ? 0 : 1, across = 1 - axis;
  std::vector<double> ends = breaks(piece.limb(), axis, low[axis], high[axis], low[across], high[across]);
  const bool at_shadow_boundary = !ends.empty();
  ends.push_back(high[across]);
  double begin = low[across];
  for (const double end : ends) {
    for_points(begin, end, at_shadow_boundary, phase, [&](double row, double row_weight) {
      const Chord part = chord(piece.limb(), axis, row, low[axis], high[axis]);
      if (part.low == part.high) return;
      for_points(part.low, part.high, part.cut, phase,
                 [&](double x, double weight) { weights.add(axis == 0 ? dvec2(x, row) : dvec2(row, x), row_weight * weight); });
    });
    begin = end;
  }
  return weights.far_field();
}

std::vector<ScatteringMatrix> curved_weights_far_field(const Illumination& light, const CurvedPiece& piece,
                                                       const ConvexPolygon& polygon, TubeSums* sums) {
  Weights weights(light, piece, sums);
  const dvec2 origin = polygon[0].at - piece.anchor();
  double low = weights.path(origin), high = low;
  for (const Corner& corner : polygon) {
    const double path = weights.path(corner.at - piece.anchor());
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
          weights.add(at, twice_area * x.weight * x.place * y.weight);
  }
  return weights.far_field();
}

}  // namespace raytube
