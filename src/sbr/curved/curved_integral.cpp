#include "sbr/curved/curved_integral.h"

#include <algorithm>
#include <cmath>

#include "math/gauss.h"
#include "scene/frequency_bands.h"

namespace raytube {

namespace {

// How a rectangle is integrated: chords along one axis, and the range of the phase along both [rad].
struct ChordRule {
  int axis;
  dvec2 phase;
};

Bounds from_anchor(const CurvedPiece& piece, const Bounds& cell) {
  return {cell.low - piece.anchor(), cell.high - piece.anchor()};
}

struct Ranges {
  dvec2 along{0.0};              // along u and along v, the larger of three rows: see turning()
  double low = 0.0, high = 0.0;  // over all nine points
  double whole() const { return high - low; }
};

// The range that a linear phase would have which asks for as many points as this one, of these values at the ends and in the
// middle: of a t + b t^2, -1 <= t = sin x <= 1, the steepest slope over x is |a| + |b| at most. Where a phase turns back it is up
// to twice its range.
double turning(double begin, double middle, double end) { return std::abs(end - begin) + std::abs(begin + end - 2.0 * middle); }

// Accumulates the integrals over a perfect conductor: of 1 and of the depth's slopes times the phase factor, at all frequencies.
class ConductorMoments {
 public:
  ConductorMoments(const Illumination& light, const CurvedPiece& piece)
      : light_(light), piece_(piece), wavenumbers_(light.surfaces.wavenumbers), sums_(wavenumbers_.size()) {
    change_ = light.receive.radial - light.grid.direction;
    along_ = {glm::dot(change_, light.grid.u_hat), glm::dot(change_, light.grid.v_hat), glm::dot(change_, light.grid.direction)};
  }

  // Exponent / k, counted from the anchor.
  double path(const dvec2& at) const { return path(at, piece_.depth(at).depth); }

  Ranges ranges(const Bounds& box) const {
    double path[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) path[i][j] = this->path(box.low + (box.high - box.low) * dvec2(0.5 * i, 0.5 * j));
    Ranges ranges{.low = path[0][0], .high = path[0][0]};
    for (int i = 0; i < 3; ++i) {
      const auto [u_low, u_high] = std::minmax({path[0][i], path[1][i], path[2][i]});
      const dvec2 along{turning(path[0][i], path[1][i], path[2][i]), turning(path[i][0], path[i][1], path[i][2])};
      ranges.along = glm::max(ranges.along, along);
      ranges.low = std::min(ranges.low, u_low);
      ranges.high = std::max(ranges.high, u_high);
    }
    return ranges;
  }

  // From here on paths lie about these: moments over a short stretch of path are known from a few wavenumbers, twice the stretch
  // as it may be wider than its ends say.
  void expect_paths(double low, double high) {
    nodes_ = light_.band ? light_.band->nodes(high - low) : nullptr;
    if (!nodes_) return;
    wavenumbers_ = nodes_->at;
    middle_ = 0.5 * (low + high);
    sums_.assign(wavenumbers_.size(), {});
  }

  // Chords along the axis over which the phase varies more.
  ChordRule chords(const Bounds& box) {
    const Ranges ranges = this->ranges(box);
    expect_paths(ranges.low, ranges.high);
    const dvec2 phase = sampling_wavenumber(light_.surfaces.wavenumbers) * ranges.along;
    return {phase.x > phase.y ? 0 : 1, phase};
  }

  void add(const dvec2& at, double weight) {
    const CurvedPiece::Depth here = piece_.depth(at);
    const double length = path(at, here.depth) - middle_;
    for (std::size_t f = 0; f < sums_.size(); ++f) {
      const Complex value = std::polar(weight, wavenumbers_[f] * length);
      sums_[f].one += value;
      sums_[f].slope_u += here.slope_u * value;
      sums_[f].slope_v += here.slope_v * value;
    }
  }

  std::vector<ScatteringMatrix> far_field() const {
    const LaunchGrid& grid = light_.grid;
    const std::array<dvec3, 2> incident{light_.transmit.theta_hat, light_.transmit.phi_hat},
        received{light_.receive.theta_hat, light_.receive.phi_hat};
    const double start = glm::dot(change_, piece_.surface().point) + middle_;
    std::vector<ScatteringMatrix> scattering(light_.surfaces.wavenumbers.size());
    for (std::size_t f = 0; f < scattering.size(); ++f) {
      const Sum sum = nodes_ ? interpolated(f) : sums_[f];
      const double k = light_.surfaces.wavenumbers[f];
      const Complex factor = Complex(0.0, -k / (2.0 * pi)) * std::polar(1.0, k * start);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) {
          const double forward = glm::dot(received[p], grid.direction);
          scattering[f].at(p, q) =
              factor *
              (glm::dot(received[p], incident[q]) * sum.one +
               forward * (glm::dot(incident[q], grid.u_hat) * sum.slope_u + glm::dot(incident[q], grid.v_hat) * sum.slope_v));
        }
    }
    return scattering;
  }

 private:
  double path(const dvec2& at, double depth) const { return along_.x * at.x + along_.y * at.y + along_.z * depth; }

  struct Sum {
    Complex one, slope_u, slope_v;
  };

  Sum interpolated(std::size_t f) const {
    Sum sum;
    for (std::size_t n = 0; n < sums_.size(); ++n) {
      const double weight = nodes_->weights[f * sums_.size() + n];
      sum.one += weight * sums_[n].one;
      sum.slope_u += weight * sums_[n].slope_u;
      sum.slope_v += weight * sums_[n].slope_v;
    }
    return sum;
  }

  const Illumination& light_;
  const CurvedPiece& piece_;
  dvec3 change_, along_;
  const ChebyshevNodes* nodes_ = nullptr;  // null: sums at all wavenumbers asked for
  std::span<const double> wavenumbers_;    // of the sums
  double middle_ = 0.0;                    // path that they are referred to [m]
  std::vector<Sum> sums_;
};

// Accumulates the integrals over any other material: of all four weights of the wave that leaves, at all frequencies.
class MaterialWeights {
 public:
  MaterialWeights(const Illumination& light, const CurvedPiece& piece, TubeSums* incoherent)
      : light_(light),
        piece_(piece),
        incoherent_(light.surfaces.any_rough() ? incoherent : nullptr),
        change_(light.receive.radial - light.grid.direction),
        arriving_(light.behind_sheets
                      ? *light.behind_sheets
                      : plain_spectrum({light.transmit.theta_hat, light.transmit.phi_hat}, light.surfaces.wavenumbers.size())),
        sums_(arriving_.size()) {}

  // Exponent / k, counted from the anchor.
  double path(const dvec2& at) const { return path(at, piece_.depth(at).depth); }

  // Materials differ from frequency to frequency: each is computed.
  void expect_paths(double, double) {}

  // Chords along the axis along which the surface is steeper in the middle. Weights vary as well as the phase: points enough for
  // its whole range, both ways.
  ChordRule chords(const Bounds& box) const {
    const Ranges ranges = ConductorMoments(light_, piece_).ranges(box);
    const dvec2 phase = sampling_wavenumber(light_.surfaces.wavenumbers) * glm::max(dvec2(ranges.whole()), ranges.along);
    const CurvedPiece::Depth middle = piece_.depth(0.5 * (box.low + box.high));
    return {std::abs(middle.slope_u) > std::abs(middle.slope_v) ? 0 : 1, phase};
  }

  // The normal and the surface per launch area follow from the slopes.
  void add(const dvec2& at, double weight) {
    const LaunchGrid& grid = light_.grid;
    const CurvedPiece::Depth here = piece_.depth(at);
    const dvec3 across = here.slope_u * grid.u_hat + here.slope_v * grid.v_hat - grid.direction;
    const double stretch = glm::length(across), length = path(at, here.depth);
    const Incidence incidence{grid.direction, across / stretch, piece_.material(), piece_.from_behind()};
    const Spectrum waves = leaving_waves(light_.surfaces, incidence, arriving_, light_.receive).reflected;
    if (incoherent_) incoherent_->add_incoherent(waves, weight);
    for (std::size_t f = 0; f < sums_.size(); ++f) {
      const Complex value = std::polar(weight * stretch, light_.surfaces.wavenumbers[f] * length);
      const ChannelWeights weights = light_.returns_alone
                                         ? radiated(incidence.normal, reflected_direction(incidence.direction, incidence.normal),
                                                    waves[f].field, light_.receive)
                                         : waves[f].weight;
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) sums_[f].at(p, q) += value * weights[p][q];
    }
  }

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
  double path(const dvec2& at, double depth) const {
    const LaunchGrid& grid = light_.grid;
    return glm::dot(change_, at.x * grid.u_hat + at.y * grid.v_hat + depth * grid.direction);
  }

  const Illumination& light_;
  const CurvedPiece& piece_;
  TubeSums* incoherent_;
  dvec3 change_;
  Spectrum arriving_;
  std::vector<ScatteringMatrix> sums_;
};

// Points enough for e^{jx} over a range of x: a rule of n points has the polynomials up to 2n - 1, and the Legendre series of
// e^{jx} ends soon after half the range (Trefethen 2013, Approximation theory and practice, chapter 8). With turning() for the
// range, of a quadratic phase all but 1e-3 of its integral's largest value.
int points_for(double phase_range) { return std::min(5 + static_cast<int>(0.3 * phase_range), most_gauss_points); }

// At the shadow boundary the depth ends like a square root; x = -cos takes that out of the integrand.
template <class Function>
void for_points(double low, double high, bool at_shadow_boundary, double phase_range, Function function) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  for (const GaussPoint& point : gauss_rule(points_for(at_shadow_boundary ? 1.6 * phase_range + 8.0 : phase_range))) {
    if (at_shadow_boundary)
      function(middle - half * std::cos(pi * point.node), half * pi * std::sin(pi * point.node) * point.weight);
    else
      function(middle + half * (2.0 * point.node - 1.0), 2.0 * half * point.weight);
  }
}

// Over a rectangle, up to the shadow boundary. Chords run along the steeper axis, so that most of them cross that boundary and do
// not touch it.
template <class Accumulator>
std::vector<ScatteringMatrix> integrate(Accumulator sums, const CurvedPiece& piece, const Bounds& cell) {
  const Bounds box = from_anchor(piece, cell);
  const ChordRule rule = sums.chords(box);
  const int axis = rule.axis, across = 1 - axis;
  const dvec2 &low = box.low, &high = box.high;
  std::vector<double> ends = breaks(piece.shadow_boundary(), axis, low[axis], high[axis], low[across], high[across]);
  const bool at_shadow_boundary = !ends.empty();
  ends.push_back(high[across]);
  double begin = low[across];
  for (const double end : ends) {
    for_points(begin, end, at_shadow_boundary, rule.phase[across], [&](double row, double row_weight) {
      const Chord part = chord(piece.shadow_boundary(), axis, row, low[axis], high[axis]);
      if (part.low == part.high) return;
      for_points(part.low, part.high, part.cut, rule.phase[axis],
                 [&](double x, double weight) { sums.add(axis == 0 ? dvec2(x, row) : dvec2(row, x), row_weight * weight); });
    });
    begin = end;
  }
  return sums.far_field();
}

// Over a polygon: the triangles of a fan, each a square collapsed to a corner (Duffy 1982).
template <class Accumulator>
std::vector<ScatteringMatrix> integrate(Accumulator sums, const Illumination& light, const CurvedPiece& piece,
                                        const ConvexPolygon& polygon) {
  const dvec2 origin = polygon[0].at - piece.anchor();
  double low = sums.path(origin), high = low;
  for (const Corner& corner : polygon) {
    const double path = sums.path(corner.at - piece.anchor());
    low = std::min(low, path);
    high = std::max(high, path);
  }
  sums.expect_paths(low, high);
  const auto rule = gauss_rule(points_for(sampling_wavenumber(light.surfaces.wavenumbers) * (high - low)) - 1);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const dvec2 a = polygon[i - 1].at - polygon[0].at, b = polygon[i].at - polygon[0].at;
    const double twice_area = a.x * b.y - a.y * b.x;
    for (const GaussPoint& x : rule)
      for (const GaussPoint& y : rule)
        if (const dvec2 at = origin + x.node * (a + y.node * (b - a)); piece.shadow_boundary()(at) > 0.0)
          sums.add(at, twice_area * x.weight * x.node * y.weight);
  }
  return sums.far_field();
}

// A perfect conductor lit by the transmitter itself, and received as it is.
bool is_plain(const Illumination& light, const CurvedPiece& piece) {
  return piece.material() == no_index && !light.behind_sheets && !light.returns_alone;
}

}  // namespace

double path_range(const Illumination& light, const CurvedPiece& piece, const Bounds& cell) {
  return ConductorMoments(light, piece).ranges(from_anchor(piece, cell)).whole();
}

std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const Bounds& cell,
                                               TubeSums* incoherent) {
  if (is_plain(light, piece)) return integrate(ConductorMoments(light, piece), piece, cell);
  return integrate(MaterialWeights(light, piece, incoherent), piece, cell);
}

std::vector<ScatteringMatrix> curved_far_field(const Illumination& light, const CurvedPiece& piece, const ConvexPolygon& polygon,
                                               TubeSums* incoherent) {
  if (is_plain(light, piece)) return integrate(ConductorMoments(light, piece), light, piece, polygon);
  return integrate(MaterialWeights(light, piece, incoherent), light, piece, polygon);
}

}  // namespace raytube
