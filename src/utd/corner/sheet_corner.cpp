#include "utd/corner/sheet_corner.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "math/dense.h"
#include "utd/corner/order_nodes.h"

namespace raytube {

namespace {

using ComplexMatrix = Eigen::MatrixXcd;

// --- the arc ---

// Densities are expansions of so many functions, solved at so many points of the arc, and radiate from so many sources on it.
constexpr int functions = 18, points = 48, sources = 96;

}  // namespace

/// Chebyshev points s = a cos(th) of the arc, from its middle, a half the angle. The soft density is sum_m c_m cos(m th) /
/// sin(th), the hard one sum_m c_m sin(m th), m from 1: as currents at edges of a sheet behave.
struct SheetCorner::Arc {
  Arc(double half_angle, int count);

  double step;  // between points, of th
  std::vector<double> s;
  // [m][point]: weights that integrate a function over s, times
  ComplexMatrix soft;         // cos(m th) / sin(th)
  ComplexMatrix hard;         // sin(m th)
  ComplexMatrix hard_slopes;  // the derivative of that
};

SheetCorner::Arc::Arc(double half_angle, int count)
    : step(pi / count), s(count), soft(functions, count), hard(functions, count), hard_slopes(functions, count) {
  for (int i = 0; i < count; ++i) {
    const double th = (i + 0.5) * step;
    s[i] = half_angle * std::cos(th);
    for (int m = 0; m < functions; ++m) {
      soft(m, i) = step * half_angle * std::cos(m * th);
      hard(m, i) = step * half_angle * std::sin(th) * std::sin((m + 1) * th);
      hard_slopes(m, i) = -step * (m + 1) * std::cos((m + 1) * th);
    }
  }
}

namespace {

/// [point][point]: the integral over th' of ln|s - s'| f(th') from f at the points.
Eigen::MatrixXd logarithms(double half_angle) {
  const double step = pi / points;
  Eigen::MatrixXd weights(points, points);
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      double sum = std::log(half_angle) - std::numbers::ln2;
      for (int m = 1; m < points; ++m) sum -= 2.0 / m * std::cos(m * (i + 0.5) * step) * std::cos(m * (j + 0.5) * step);
      weights(i, j) = step * sum;
    }
  return weights;
}

/// g and tan(d/2) dg/dd between the points of the arc, d their distance, as matrices that integrate over th'. Each is split into
/// ln(d) times P_{nu-1/2}(cos d) or its derivative, and a smooth rest.
struct Kernels {
  Kernels(std::span<const double> s, const Eigen::MatrixXd& logarithms, Complex nu, const RadialWave& green)
      : value(points, points), slope(points, points) {
    const double step = pi / points;
    const Complex factor = -2.0 / pi * std::cos(pi * nu);  // P = 4 cos(pi nu) g at the angle pi - d
    for (int i = 0; i < points; ++i)
      for (int j = 0; j <= i; ++j) {
        const double d = std::abs(s[i] - s[j]), logs = logarithms(i, j);
        const RadialWave::Values opposite = green.at(-std::cos(d));
        Complex smooth = green.smooth_at_source(), smooth_slope = -0.25 / pi;
        const Complex p = factor * opposite.value, q = factor * opposite.slope * (std::sin(d) * std::tan(d / 2));
        if (i != j) {
          const RadialWave::Values g = green.at(std::cos(d));
          smooth = g.value - p * std::log(d);
          smooth_slope = -std::sin(d) * std::tan(d / 2) * g.slope - q * std::log(d);
        }
        value(i, j) = value(j, i) = p * logs + smooth * step;
        slope(i, j) = slope(j, i) = q * logs + smooth_slope * step;
      }
  }

  ComplexMatrix value, slope;
};

}  // namespace

SheetCorner::SheetCorner(double angle) : half_angle_(angle / 2), sources_(sources) {
  const Arc arc(half_angle_, points), fine(half_angle_, sources);
  const Eigen::MatrixXd logs = logarithms(half_angle_);
  for (int i = 0; i < sources; ++i) sources_[i].point = {std::cos(fine.s[i]), std::sin(fine.s[i]), 0.0};
  // The densities' roots at the edge: a sum over all functions, with their values or slopes there.
  const Eigen::VectorXcd soft_end = Eigen::VectorXcd::Constant(functions, std::sqrt(angle) / 4);
  const Eigen::VectorXcd hard_end = Eigen::VectorXcd::LinSpaced(functions, 1, functions) / (-2 * std::sqrt(angle));
  const std::vector<OrderNode> nodes = nodes_over_orders();
  for (std::size_t order = 0; order < nodes.size(); ++order) {
    const OrderNode& node = nodes[order];
    const RadialWave& green = RadialBasis::of_all_orders().wave(order);
    const Kernels kernels(arc.s, logs, node.nu, green);
    const Complex eigenvalue = node.nu * node.nu - 0.25;
    const ComplexMatrix soft = arc.soft * kernels.value * arc.soft.transpose() / arc.step;
    const ComplexMatrix hard = (arc.hard * (eigenvalue * kernels.value - kernels.slope) * arc.hard.transpose() -
                                arc.hard_slopes * kernels.value * arc.hard_slopes.transpose()) /
                               arc.step;
    const Eigen::VectorXcd soft_sources = fine.soft.transpose() * soft.partialPivLu().solve(soft_end);
    const Eigen::VectorXcd hard_sources = fine.hard.transpose() * hard.partialPivLu().solve(hard_end);
    for (int i = 0; i < sources; ++i) {
      sources_[i].soft.add(node.weight * soft_sources[i], order);
      sources_[i].hard.add(node.weight * hard_sources[i], order);
    }
  }
}

std::size_t SheetCorner::bytes() { return sources * sizeof(Source); }

// The trapezoidal rule loses its digits closer to the sheet than 2.2 times the distance between its points.
double SheetCorner::nearest_height(const dvec3& towards) const {
  const double s = std::atan2(towards.y, towards.x);
  return std::abs(s) >= half_angle_ ? 0.0 : 2.2 * pi / sources * std::sqrt(half_angle_ * half_angle_ - s * s);
}

SheetCorner::Gradients SheetCorner::gradients(const dvec3& towards) const {
  Gradients sum;
  for (const Source& source : sources_) {
    const RadialBasis::Slopes at = RadialBasis::of_all_orders().at(glm::dot(source.point, towards));
    sum.soft += source.soft.slope(at) * source.point;
    sum.hard += (source.hard.bend(at) * towards.z) * source.point + source.hard.slope(at) * dvec3(0, 0, 1);
  }
  return sum;
}

// On the sheet the soft potential is zero, and the hard one has no slope off it.
SheetCorner::Start SheetCorner::start(const dvec3& towards) const {
  const double least = std::sin(nearest_height(towards)), height = std::abs(towards.z);
  const dvec3 along =
      glm::normalize(std::abs(towards.z) < 0.99 ? dvec3(-towards.y, towards.x, 0) : dvec3(0, towards.z, -towards.y));
  const dvec3 up = glm::cross(towards, along);
  dvec3 source = towards;
  double share = 1.0;
  if (height < least) {
    const double side = std::signbit(towards.z) ? -1.0 : 1.0;
    source = std::sqrt(1 - least * least) * glm::cross(along, dvec3(0, 0, 1)) + dvec3(0, 0, side * least);
    share = height / least;
  }
  const dvec3 source_up = glm::cross(source, along);
  const Gradients g = gradients(source);
  const Complex soft_along = share * dot(g.soft, along), soft_up = dot(g.soft, source_up);
  const Complex hard_along = dot(g.hard, along), hard_up = share * dot(g.hard, source_up);
  return {(soft_along - hard_up) * along, (soft_up + hard_along) * up};
}

}  // namespace raytube
