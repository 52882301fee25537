#include "utd/sheet/sheet_half_plane.h"

#include <algorithm>
#include <cmath>

#include "math/gauss.h"

namespace raytube {

namespace {

// The |b| below which a wave meets the rim at a right angle: there the two channels are apart.
constexpr double normal_incidence = 1e-7;

SplitFunction curl_split(const SheetAdmittance& y, double sin_cone) {
  const Complex quadratic = y.normal + y.slope;
  return {SheetChannel::curl, (y.constant + quadratic * (1 - sin_cone * sin_cone)) / sin_cone, quadratic * sin_cone};
}

// The tilt of the branch cut that keeps it away from guided waves, but for those within 1e-6 of the branch point, as metals have
// them, which carry nothing; further down, waves at a rim that is not parallel would come from both sides of their root.
double widest_gap(const SplitFunction& function, double slowest) {
  std::vector<double> angles;
  for (const double tilt : {0.0, 1.2})
    for (const Complex& wave : function.guided(slowest, tilt))
      if (std::abs(wave - 1.0) > 1e-6) angles.push_back(std::arg(wave - 1.0) + pi / 2);
  if (std::ranges::none_of(angles, [](double angle) { return std::abs(angle) < 0.6; })) return 0.0;
  double best = -1.0, result = 0.0;
  for (const double tilt : {0.0, 0.3, 0.5, 0.7}) {
    double gap = 0.9;
    for (const double angle : angles) gap = std::min(gap, std::abs(angle + tilt));
    gap *= std::pow(std::cos(tilt), 0.3);
    if (gap > best) best = gap, result = tilt;
  }
  return result;
}

}  // namespace

SheetHalfPlane::SheetHalfPlane(const SheetAdmittance& sheet, double slowest, double sin_cone, double shortest)
    : sheet_(sheet),
      sin_cone_(sin_cone),
      cone2_(1 - sin_cone * sin_cone),
      curl_(curl_split(sheet, sin_cone)),
      divergence_(SheetChannel::divergence, sheet.divergence * sin_cone, 0.0) {
  if (sheet_.normal != 0.0) {
    root_ = std::sqrt(-sheet_.constant / sheet_.normal - cone2_);
    if (root_.imag() < 0.0) root_ = -root_;
    const Complex z = split(SheetChannel::curl, -root_);
    ratio_ = 0.5 / (z * z);
  }
  const Complex tie = imaginary_unit * std::sqrt(std::max(cone2_, 0.0));
  tie_curl_ = {split(SheetChannel::curl, -tie), split(SheetChannel::curl, tie)};
  tie_divergence_ = {split(SheetChannel::divergence, -tie), split(SheetChannel::divergence, tie)};
  const Complex straight = sheet_.exact(1.0)[1];
  tie_fit_ = (2.0 + sheet_.divergence) * straight / (2.0 + straight) - sheet_.divergence;
  launch(SheetChannel::curl, curl_, slowest, shortest);
  launch(SheetChannel::divergence, divergence_, slowest, shortest);
}

Complex SheetHalfPlane::split(SheetChannel channel, Complex nu, Complex within) const {
  if (channel == SheetChannel::curl) return curl_.at(nu / sin_cone_);
  return divergence_.at(nu / sin_cone_) * std::exp(-within * sheet_.end_face);
}

SheetWave SheetHalfPlane::fitted_wave(SheetChannel channel, Complex nu, Complex within) const {
  const Complex a2 = nu * nu + cone2_, fitted = within * within + cone2_;
  return {nu, a2, channel == SheetChannel::curl ? sheet_.slope * fitted : 0.0, std::exp(-within * sheet_.end_face),
          std::exp(-within * sheet_.normal_end_face)};
}

// delta = Q_fit y_exact / Q_exact - y_fit: with it the pole at nu = -c has the plate's own physical optics.
SheetWave SheetHalfPlane::real_wave(SheetChannel channel, double nu, double within) const {
  SheetWave wave = fitted_wave(channel, nu, within);
  const double a2 = nu * nu + cone2_;
  if (a2 >= 1.0) return wave;
  const double s = std::sqrt(1 - a2);
  const auto [curl, divergence] = sheet_.exact(s);
  if (channel == SheetChannel::curl) {
    const Complex y = sheet_.constant + (sheet_.normal + sheet_.slope) * a2;
    wave.fit += (2 * s + y) * curl / (2 * s + curl) - y;
  } else {
    wave.fit += (2.0 + s * sheet_.divergence) * divergence / (2.0 + s * divergence) - sheet_.divergence;
  }
  return wave;
}

// What the branch cut sends along the sheet is carried by 24 waves, down to e^{-4.5^2} at the end of the shortest strip.
void SheetHalfPlane::launch(SheetChannel channel, const SplitFunction& function, double slowest, double shortest) {
  const double tilt = widest_gap(function, 1.2 * slowest / sin_cone_);
  const Complex turn = -imaginary_unit * std::polar(1.0, -tilt);
  const double range = 4.5 / std::sqrt(shortest * std::cos(tilt));
  const auto add = [&](Complex along, Complex strength) {
    const Complex v = sin_cone_ * along;
    const SheetWave wave = complex_wave(channel, v);
    launched_.push_back({channel, wave, along, sin_cone_ * strength / (2.0 * imaginary_unit * split(channel, v))});
  };
  for (const auto& [x, weight] : gauss_rule(24)) {
    const double root = range * x * x;  // tau = root^2, close to 0 where the cut begins
    const double dtau = 4 * root * range * x * weight;
    const Complex along = 1.0 + turn * root * root;
    add(along, turn * dtau * imaginary_unit * function.jump(along) / pi);
  }
  for (const Complex& along : function.guided(1.2 * slowest / sin_cone_, tilt)) add(along, 2.0 * function.residue(along, tilt));
}

std::array<SheetSource, 2> SheetHalfPlane::plane_wave(double c, double b, const SheetVector& incident) const {
  const Complex z_curl = split(SheetChannel::curl, -c), z_divergence = split(SheetChannel::divergence, -c);
  return {{{SheetChannel::curl, real_wave(SheetChannel::curl, c, c), (b * incident.across - c * incident.along) * z_curl,
            incident.along * z_curl},
           {SheetChannel::divergence, real_wave(SheetChannel::divergence, c, c),
            (-c * incident.across - b * incident.along) * z_divergence, incident.across * z_divergence}}};
}

// The wave's current C or D: E Z(-c) = C / (2 y Z(c)), and its component -c E / a2.
SheetSource SheetHalfPlane::arriving(SheetChannel channel, Complex a2, Complex near) const {
  Complex c = std::sqrt(a2 - cone2_);
  if ((c * std::conj(near)).real() < 0.0) c = -c;
  const Complex y = channel == SheetChannel::curl ? sheet_.constant + (sheet_.normal + sheet_.slope) * a2 : sheet_.divergence;
  const Complex strength = 0.5 / (y * split(channel, c));
  return {channel, complex_wave(channel, c), strength, -c / a2 * strength};
}

// 2 j E Z(-c) N / (nu + c).
Complex SheetHalfPlane::bare(const SheetSource& source, Complex nu) const {
  const Complex c = source.wave.nu;
  const Complex n =
      source.channel == SheetChannel::curl ? sheet_.constant + sheet_.normal * (cone2_ - nu * c) : sheet_.divergence;
  return 2.0 * imaginary_unit * source.strength * n / (nu + c);
}

// What the fit has beyond that, as a mean of both waves, and the end face for polarisation across the sheet: a current without
// divergence whose place moves. Of the divergence over e^{-nu L}.
Complex SheetHalfPlane::fitted(const SheetSource& source, const SheetWave& at) const {
  const SheetWave& from = source.wave;
  const Complex over = 1.0 / (at.nu + from.nu), mean = 0.5 * (at.fit + from.fit) * over;
  if (source.channel == SheetChannel::curl) {
    const Complex moved = sheet_.normal * at.a2 * (1.0 / (at.normal_end_face * from.normal_end_face) - 1.0) * over;
    return 2.0 * imaginary_unit * (source.strength * (mean + moved) + source.component * 0.5 * at.fit);
  }
  return 2.0 * imaginary_unit * from.end_face * (source.strength * mean + source.component * 0.5 * at.fit);
}

std::array<Complex, 2> SheetHalfPlane::sums(std::span<const SheetSource> sources, Complex nu, bool with_fit) const {
  std::array<Complex, 2> sum{};
  const SheetWave curl = complex_wave(SheetChannel::curl, nu);
  SheetWave divergence = complex_wave(SheetChannel::divergence, nu);
  divergence.fit = tie_fit_;
  for (const SheetSource& source : sources) {
    const bool is_curl = source.channel == SheetChannel::curl;
    Complex& part = sum[is_curl ? 0 : 1];
    if (!with_fit)
      part += bare(source, nu);
    else
      part += is_curl ? fitted(source, curl) : divergence.end_face * fitted(source, divergence);
  }
  return sum;
}

EdgeConstants SheetHalfPlane::constants(std::span<const SheetSource> sources, double b) const {
  EdgeConstants result{};
  if (std::abs(b) < normal_incidence)
    constants_at_normal(sources, result);
  else
    constants_on_cone(sources, b, result);
  return result;
}

// C and D vanish with nu there.
void SheetHalfPlane::constants_at_normal(std::span<const SheetSource> sources, EdgeConstants& result) const {
  const auto [curl, divergence] = sums(sources, 0.0, false);
  const auto [fit_curl, fit_divergence] = sums(sources, 0.0, true);
  result = {-curl, 0.0, -divergence, -fit_curl, -fit_divergence};
  if (sheet_.normal == 0.0) return;
  const Complex ahead = sums(sources, root_, false)[0] - curl, behind = sums(sources, -root_, false)[0] - curl;
  result.curl_slope = (ratio_ * behind - ahead) / (root_ * (1.0 + ratio_));
}

// The ties are linear in the constants of both channels; the slope is eliminated by the third condition,
// slope u (1 + rho) = rho Phi(-u) - Phi(u) - (1 - rho) constant.
void SheetHalfPlane::constants_on_cone(std::span<const SheetSource> sources, double b, EdgeConstants& result) const {
  const Complex tie = imaginary_unit * std::abs(b);
  const std::array<Complex, 2> weight_curl{b * tie_curl_[0], b * tie_curl_[1]},
      weight_divergence{tie * tie_divergence_[0], -tie * tie_divergence_[1]};
  Complex slope = 0.0, slope_per_constant = 0.0;
  if (sheet_.normal != 0.0) {
    const Complex over = 1.0 / (root_ * (1.0 + ratio_));
    slope = (ratio_ * sums(sources, -root_, false)[0] - sums(sources, root_, false)[0]) * over;
    slope_per_constant = -(1.0 - ratio_) * over;
  }
  const std::array<Complex, 2> at{tie, -tie};
  std::array<std::array<Complex, 2>, 2> matrix, fit_matrix;
  std::array<Complex, 2> right, fit_right;
  for (int i = 0; i < 2; ++i) {
    const auto [curl, divergence] = sums(sources, at[i], false);
    const auto [fit_curl, fit_divergence] = sums(sources, at[i], true);
    const Complex moved = std::exp(-at[i] * sheet_.end_face);
    matrix[i] = {weight_curl[i] * (1.0 + slope_per_constant * at[i]), weight_divergence[i]};
    fit_matrix[i] = {weight_curl[i], weight_divergence[i] * moved};
    right[i] = -(weight_curl[i] * (curl + slope * at[i]) + weight_divergence[i] * divergence);
    fit_right[i] = -(weight_curl[i] * fit_curl + weight_divergence[i] * fit_divergence);
  }
  const auto solve = [](const auto& m, const auto& r) {
    const Complex determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    return std::array{(r[0] * m[1][1] - m[0][1] * r[1]) / determinant, (m[0][0] * r[1] - r[0] * m[1][0]) / determinant};
  };
  const auto [curl, divergence] = solve(matrix, right);
  const auto [fit_curl, fit_divergence] = solve(fit_matrix, fit_right);
  result = {curl, slope + slope_per_constant * curl, divergence, fit_curl, fit_divergence};
}

Complex SheetHalfPlane::bracket(std::span<const SheetSource> sources, const EdgeConstants& constants, SheetChannel channel,
                                const SheetWave& at) const {
  Complex sum = 0.0, fit = 0.0;
  for (const SheetSource& source : sources) {
    if (source.channel != channel) continue;
    sum += bare(source, at.nu);
    fit += fitted(source, at);
  }
  if (channel == SheetChannel::curl) return sum + fit + constants.curl + constants.curl_slope * at.nu + constants.fit_curl;
  return sum + constants.divergence + at.end_face * (fit + constants.fit_divergence);
}

// What is fitted to homogeneous waves is not followed beyond them, where observers are far off the cone, or beyond the wave that
// arrives: there the moment has its pole.
SheetVector SheetHalfPlane::moment(std::span<const SheetSource> sources, const EdgeConstants& constants, double nu,
                                   double b) const {
  double furthest = sin_cone_;
  for (const SheetSource& source : sources) furthest = std::max(furthest, source.wave.nu.real());
  const double within = std::max(nu, -furthest);
  const auto of = [&](SheetChannel channel) {
    return split(channel, -nu, -within) * bracket(sources, constants, channel, real_wave(channel, nu, within));
  };
  const Complex c = of(SheetChannel::curl), d = of(SheetChannel::divergence);
  if (std::abs(b) < normal_incidence) return {d / nu, c / nu};
  const double a2 = nu * nu + b * b;
  return {(nu * d + b * c) / a2, (-b * d + nu * c) / a2};
}

SheetVector SheetHalfPlane::physical_optics(double nu, double c, double b, const SheetVector& incident) const {
  const double a2 = c * c + b * b, s = std::sqrt(std::max(1 - a2, 0.0));
  const auto [curl, divergence] = sheet_.exact(s);
  const Complex along = (c * incident.across + b * incident.along) * 2.0 * divergence / (2.0 + s * divergence) / a2,
                across = (-b * incident.across + c * incident.along) * 2.0 * s * curl / (2.0 * s + curl) / a2,
                end = imaginary_unit / (nu + c);
  return {end * (c * along - b * across), end * (b * along + c * across)};
}

SheetVector current_of(SheetChannel channel, Complex nu, Complex a2, double b) {
  return channel == SheetChannel::curl ? SheetVector{b / a2, nu / a2} : SheetVector{nu / a2, -b / a2};
}

SheetVector sheet_fringe(const SheetHalfPlane& half_plane, double nu, double c, double b, const SheetVector& incident) {
  const std::array<SheetSource, 2> sources = half_plane.plane_wave(c, b, incident);
  const EdgeConstants constants = half_plane.constants(sources, b);
  const auto at = [&](double x) {
    return half_plane.moment(sources, constants, x, b) - half_plane.physical_optics(x, c, b, incident);
  };
  // Closer to a pole that cancels than this nu is not evaluated.
  constexpr double apart = 2e-5;
  const bool at_pole = std::abs(nu + c) < apart;
  if (!at_pole && std::hypot(nu, b) > apart) return at(nu);
  const double middle = at_pole ? -c : nu;
  const SheetVector below = at(middle - 1.5 * apart), above = at(middle + 1.5 * apart);
  return {0.5 * (below.across + above.across), 0.5 * (below.along + above.along)};
}

}  // namespace raytube
