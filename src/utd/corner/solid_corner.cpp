#include "utd/corner/solid_corner.h"

#include <algorithm>
#include <cmath>

#include "core/angle.h"
#include "math/dense.h"
#include "math/gauss.h"
#include "utd/corner/order_nodes.h"

namespace raytube {

namespace {

using ComplexMatrix = Eigen::MatrixXcd;
using ComplexRow = Eigen::RowVectorXcd;

// Densities are solved at the first number of points of a side, and interpolated to the second one for what they radiate.
constexpr int side_points = 16, fine_points = 40;
// The circle about the edge on which its harmonic is taken: points, and its angle from the edge [rad].
constexpr int crossings = 16;
constexpr double circle = 0.2;

/// The part of a side up to the parameter t of 0 to 2 pi, and its derivative: Kress's third power.
std::pair<double, double> graded(double t) {
  constexpr double p = 3.0, c = 1.0 / p - 0.5;
  const auto v = [&](double x) { return c * std::pow((pi - x) / pi, 3) + (x - pi) / (p * pi) + 0.5; };
  const double slope = -3 * c / pi * std::pow((pi - t) / pi, 2) + 1 / (p * pi);  // slope of v at t and at 2 pi - t
  const double from = v(t), to = v(2 * pi - t), a = std::pow(from, p), b = std::pow(to, p);
  const double da = p * std::pow(from, p - 1) * slope, db = -p * std::pow(to, p - 1) * slope;
  return {a / (a + b), (da * b - a * db) / ((a + b) * (a + b))};
}

/// Weights of the integral over t' of ln(4 sin^2((t - t') / 2)) f(t') by the steps between t and t' (Kress 1990).
Eigen::VectorXd logarithm_weights() {
  constexpr int half = side_points / 2;
  Eigen::VectorXd weights(side_points);
  for (int i = 0; i < side_points; ++i) {
    const double t = 2 * pi * i / side_points;
    double sum = std::cos(half * t) / (2.0 * half);
    for (int m = 1; m < half; ++m) sum += std::cos(m * t) / m;
    weights[i] = -2 * pi / half * sum;
  }
  return weights;
}

/// From weights of an integral at the points to those at the fine ones, by trigonometric interpolation.
Eigen::MatrixXd refinement() {
  Eigen::MatrixXd rows(side_points, fine_points);
  for (int i = 0; i < side_points; ++i)
    for (int j = 0; j < fine_points; ++j) {
      const double x = 2 * pi * ((j + 0.5) / fine_points - (i + 0.5) / side_points);
      rows(i, j) = std::sin(side_points * x / 2) / (side_points * std::tan(x / 2)) * side_points / fine_points;
    }
  return rows;
}

/// tan(d/2)^m F(1/2 - nu, 1/2 + nu; 1 + m; sin^2(d/2)) 2^m, which is d^m near d = 0 (Abramowitz & Stegun 1964, 8.1.2), m = 1/n.
Complex radial_function(Complex nu, double m, double d) {
  const double x = std::pow(std::sin(d / 2), 2);
  Complex term = 1.0, sum = 1.0;
  for (int i = 0; std::abs(term) > 1e-14 * std::abs(sum); ++i)
    sum += term *= (0.5 - nu + double(i)) * (0.5 + nu + double(i)) / ((1 + m + i) * (i + 1.0)) * x;
  return std::pow(2 * std::tan(d / 2), m) * sum;
}

}  // namespace

/// Points of all three sides, one after the other.
struct SolidCorner::Sides {
  Sides(const std::array<dvec3, 3>& edges, const std::array<dvec3, 3>& normals, int count) {
    for (int side = 0; side < 3; ++side) {
      const dvec3 &from = edges[side], &to = edges[(side + 1) % 3];
      const double angle = std::acos(glm::dot(from, to));
      const dvec3 across = glm::normalize(to - glm::dot(from, to) * from);
      for (int i = 0; i < count; ++i) {
        const auto [part, slope] = graded(2 * pi * (i + 0.5) / count);
        position.push_back(std::cos(angle * part) * from + std::sin(angle * part) * across);
        normal.push_back(normals[side]);
        speed.push_back(angle * slope);
        weight.push_back(angle * slope * 2 * pi / count);
      }
    }
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(position.size()); }

  std::vector<dvec3> position, normal;
  std::vector<double> speed, weight;  // ds/dt, and that times the step of t
};

namespace {

/// Both integral equations as matrices, [at][from]: the soft potential on the sides, the hard one's slope there.
template <class Sides>
struct Equations {
  Equations(const Sides& sides, const Eigen::VectorXd& logarithms, Complex nu, const RadialWave& green)
      : soft(sides.size(), sides.size()), hard(-0.5 * ComplexMatrix::Identity(sides.size(), sides.size())) {
    const Complex p_factor = -std::cos(pi * nu) / pi;  // g = p ln(t) + rest, t = (1 - cos) / 2, p = p_factor g(-cos)
    for (int i = 0; i < sides.size(); ++i) {
      const Complex rest = green.smooth_at_source() - (std::numbers::ln2 + std::log(sides.speed[i] / 2)) / (2 * pi);
      soft(i, i) = rest * sides.weight[i] - logarithms[0] * sides.speed[i] / (4 * pi);
      for (int j = 0; j < i; ++j) {
        const dvec3 apart = sides.position[i] - sides.position[j];
        const double cosine = 1.0 - glm::dot(apart, apart) / 2;
        const RadialWave::Values g = green.at(cosine);
        if (i / side_points == j / side_points) {
          const Complex p = p_factor * green.at(-cosine).value;
          const double sine = std::sin(pi * (i - j) / side_points);
          const Complex smooth = g.value - p * std::log(4 * sine * sine);
          soft(i, j) = p * logarithms[i - j] * sides.speed[j] + smooth * sides.weight[j];
          soft(j, i) = p * logarithms[i - j] * sides.speed[i] + smooth * sides.weight[i];
        } else {
          soft(i, j) = g.value * sides.weight[j], soft(j, i) = g.value * sides.weight[i];
          hard(i, j) = g.slope * glm::dot(sides.normal[i], sides.position[j]) * sides.weight[j];
          hard(j, i) = g.slope * glm::dot(sides.normal[j], sides.position[i]) * sides.weight[i];
        }
      }
    }
  }

  ComplexMatrix soft, hard;
};

}  // namespace

SolidCorner::SolidCorner(const SolidCornerShape& shape) {
  const auto at = [](double angle, double turn) {
    return dvec3(std::cos(angle), std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn));
  };
  const std::array<dvec3, 3> edges{at(0, 0), at(shape.first, 0), at(shape.second, shape.metal)};
  for (int side = 0; side < 3; ++side) normals_[side] = -glm::normalize(glm::cross(edges[side], edges[(side + 1) % 3]));
  const Sides sides(edges, normals_, side_points), fine(edges, normals_, fine_points);
  for (int i = 0; i < fine.size(); ++i) sources_.push_back({fine.position[i], fine.normal[i], fine.weight[i], {}, {}});
  const double m = 1.0 / shape.n();
  Eigen::VectorXd first_sine(crossings), first_cosine(crossings);
  for (int i = 0; i < crossings; ++i) {
    const GaussPoint& point = gauss_rule(crossings)[i];
    const double chi = point.node * shape.n() * pi;
    crossings_.push_back({at(circle, -chi), {}, {}});
    first_sine[i] = 2 * m * point.weight * std::sin(m * chi);
    first_cosine[i] = 2 * m * point.weight * std::cos(m * chi);
  }
  const Eigen::VectorXd logarithms = logarithm_weights();
  const Eigen::MatrixXd finer = refinement();
  ComplexMatrix field(crossings, sides.size());
  const std::vector<OrderNode> nodes = nodes_over_orders();
  for (std::size_t order = 0; order < nodes.size(); ++order) {
    const OrderNode& node = nodes[order];
    const RadialWave& green = RadialBasis::of_all_orders().wave(order);
    const Equations equations(sides, logarithms, node.nu, green);
    const Complex factor = node.weight / radial_function(node.nu, m, circle);
    for (int i = 0; i < crossings; ++i) {
      crossings_[i].soft.add(factor * first_sine[i], order);
      crossings_[i].hard.add(factor * first_cosine[i], order);
      for (int j = 0; j < sides.size(); ++j)
        field(i, j) = green.at(glm::dot(crossings_[i].point, sides.position[j])).value * sides.weight[j];
    }
    const ComplexRow soft = (field.transpose() * first_sine).transpose(), hard = (field.transpose() * first_cosine).transpose();
    const Eigen::VectorXcd soft_sent = equations.soft.transpose().partialPivLu().solve(soft.transpose());
    const Eigen::VectorXcd hard_sent = equations.hard.transpose().partialPivLu().solve(hard.transpose());
    for (int side = 0; side < 3; ++side) {
      const Eigen::VectorXcd soft_fine = finer.transpose() * soft_sent.segment(side * side_points, side_points);
      const Eigen::VectorXcd hard_fine = finer.transpose() * hard_sent.segment(side * side_points, side_points);
      for (int i = 0; i < fine_points; ++i) {
        sources_[side * fine_points + i].soft.add(-factor * soft_fine[i], order);
        sources_[side * fine_points + i].hard.add(-factor * hard_fine[i], order);
      }
    }
  }
}

std::size_t SolidCorner::bytes() { return (3 * fine_points + crossings) * sizeof(Source); }

SolidCorner::Gradients SolidCorner::gradients(const dvec3& towards) const {
  const RadialBasis& basis = RadialBasis::of_all_orders();
  Gradients sum;
  for (const Source& source : sources_) {
    const RadialBasis::Slopes at = basis.at(glm::dot(source.point, towards));
    sum.soft += source.soft.slope(at) * source.point;
    sum.hard += (source.hard.bend(at) * glm::dot(towards, source.normal)) * source.point + source.hard.slope(at) * source.normal;
  }
  for (const Crossing& crossing : crossings_) {
    const RadialBasis::Slopes at = basis.at(glm::dot(crossing.point, towards));
    sum.soft += crossing.soft.slope(at) * crossing.point;
    sum.hard += crossing.hard.slope(at) * crossing.point;
  }
  return sum;
}

namespace {

/// A direction closer to the edge than 20 degrees is the one at the same side of it that far away.
dvec3 off_edge(const dvec3& towards) {
  constexpr double nearest = 20.0 * degree;
  if (towards.x <= 0 || std::hypot(towards.y, towards.z) >= std::sin(nearest)) return towards;
  const double turn = std::atan2(towards.z, towards.y);
  return {std::cos(nearest), std::sin(nearest) * std::cos(turn), std::sin(nearest) * std::sin(turn)};
}

/// A field upright on one direction, turned with it into another one.
ComplexVector turned(const ComplexVector& field, const dvec3& from, const dvec3& to) {
  const dvec3 axis = glm::cross(from, to);
  if (glm::length(axis) < 1e-12) return field;
  const dvec3 across = glm::normalize(axis);
  return dot(field, across) * across + dot(field, glm::cross(across, from)) * glm::cross(across, to);
}

}  // namespace

/// A direction close to a face is lifted off it by 2.2 spacings of the points: from there on the trapezoidal rule has its digits.
SolidCorner::Raised SolidCorner::raised(const dvec3& source) const {
  const auto& closest = *std::ranges::max_element(sources_, {}, [&](const Source& s) { return glm::dot(s.point, source); });
  const dvec3 other = std::abs(source.x) < 0.8 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const double least = std::min(2.2 * closest.spacing, 0.5);
  if (angle_between(closest.point, source) >= least) return {source, glm::normalize(glm::cross(other, source)), 1.0};
  const dvec3 along = glm::normalize(glm::cross(closest.normal, source));
  const double height = std::clamp(glm::dot(source, closest.normal) / std::sin(least), 0.0, 1.0);
  if (height == 1.0) return {source, along, 1.0};
  return {std::cos(least) * glm::cross(along, closest.normal) + std::sin(least) * closest.normal, along, height};
}

// On the face the soft potential is zero, and the hard one has no slope off it.
ComplexVector SolidCorner::start(const dvec3& towards) const {
  if (std::ranges::all_of(normals_, [&](const dvec3& normal) { return glm::dot(normal, towards) <= -1e-9; })) return {};
  const dvec3 beside = off_edge(towards);
  const Raised source = raised(beside);
  const dvec3 source_up = glm::cross(source.towards, source.along);
  const Gradients g = gradients(source.towards);
  const Complex soft_along = source.height * dot(g.soft, source.along), soft_up = dot(g.soft, source_up);
  const Complex hard_along = dot(g.hard, source.along), hard_up = source.height * dot(g.hard, source_up);
  return turned((soft_along - hard_up) * source.along + (soft_up + hard_along) * glm::cross(beside, source.along), beside,
                towards);
}

}  // namespace raytube
