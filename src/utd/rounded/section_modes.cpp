#include "utd/rounded/section_modes.h"

#include <cmath>

#include "math/dense.h"
#include "math/special/bessel.h"

namespace raytube {

namespace {

using Matrix = Eigen::MatrixXcd;
using Index = Eigen::Index;

// A corner takes nodes to it as the sixth power of their distance; in s of 0 to 2 pi.
struct Graded {
  double value, slope;
};

Graded graded(double t) {
  constexpr int p = 6;
  const auto cubic = [](double s) { return (1.0 / p - 0.5) * std::pow(1 - s / pi, 3) + (s / pi - 1) / p + 0.5; };
  const auto slope = [](double s) { return (-3 * (1.0 / p - 0.5) * (1 - s / pi) * (1 - s / pi) + 1.0 / p) / pi; };
  const double s = 2 * pi * t, from = cubic(s), to = cubic(2 * pi - s);
  const double a = std::pow(from, p), b = std::pow(to, p);
  const double da = p * std::pow(from, p - 1) * slope(s), db = -p * std::pow(to, p - 1) * slope(2 * pi - s);
  return {a / (a + b), 2 * pi * (da * b - a * db) / ((a + b) * (a + b))};
}

struct Node {
  dvec2 position, normal;
  double speed, curvature;
};

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

// The circle from face 0 to face 1, and back over the section: half of the nodes on each.
std::vector<Node> nodes_of(const Section& section, double n, double radius, int count) {
  const auto circle = [&](double u) {
    const double angle = n * pi * u, turn = n * pi;
    const dvec2 out(std::cos(angle), std::sin(angle)), along(-out.y, out.x);
    return SectionPoint{radius * out, radius * turn * along, -radius * turn * turn * out};
  };
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    const double place = 2 * (i + 0.5) / count;
    const bool on_circle = place < 1;
    const Graded grade = graded(on_circle ? place : place - 1);
    const SectionPoint at = on_circle ? circle(grade.value) : section(grade.value);
    const double stretch = glm::length(at.slope);
    nodes.push_back({at.position, dvec2(at.slope.y, -at.slope.x) / stretch, stretch * grade.slope / pi,
                     cross(at.slope, at.bend) / (stretch * stretch * stretch)});
  }
  return nodes;
}

// Weights of Kress's rule for ln(4 sin^2((s - s') / 2)), by the distance of two nodes.
std::vector<double> logarithmic_weights(int count) {
  const int half = count / 2;
  std::vector<double> weights;
  for (int i = 0; i < count; ++i) {
    double sum = 0.0;
    for (int m = 1; m < half; ++m) sum += std::cos(m * i * pi / half) / m;
    weights.push_back(-2 * pi / half * sum - pi / (half * half) * std::cos(i * pi));
  }
  return weights;
}

// 2 INT dG/dn and 2 INT G, G = -(j/4) H0(r) of e^{+jwt}.
struct Layers {
  Matrix twofold, single;
};

void set_diagonal(Layers& layers, const Node& node, Index i, double log_weight, double step) {
  layers.twofold(i, i) = -step * node.curvature * node.speed / (2 * pi);
  layers.single(i, i) =
      node.speed * (-log_weight / (2 * pi) - step * Complex(std::numbers::egamma / pi + std::log(node.speed / 2) / pi, 0.5));
}

void set_pair(Layers& layers, const Node& to, const Node& from, Index i, Index j, double log_weight, double log, double step) {
  const dvec2 away = to.position - from.position;
  const double r = glm::length(away), across = glm::dot(away, from.normal) / r * from.speed;
  const double split = log_weight - step * log;
  layers.twofold(i, j) = across * (-::j1(r) / (2 * pi) * split - step * Complex(0, 0.5) * Complex(::j1(r), -::y1(r)));
  layers.single(i, j) = from.speed * (-::j0(r) / (2 * pi) * split - step * Complex(0, 0.5) * Complex(::j0(r), -::y0(r)));
}

Layers layers_of(const std::vector<Node>& nodes) {
  const auto count = static_cast<int>(nodes.size());
  const std::vector<double> weights = logarithmic_weights(count);
  const double step = 2 * pi / count;
  Layers layers{Matrix(count, count), Matrix(count, count)};
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      const double log_weight = weights[std::abs(i - j)], sine = std::sin((i - j) * step / 2);
      if (i == j)
        set_diagonal(layers, nodes[i], i, log_weight, step);
      else
        set_pair(layers, nodes[i], nodes[j], i, j, log_weight, std::log(4 * sine * sine), step);
    }
  layers.twofold.diagonal().array() += 1.0;
  return layers;
}

// J and H2 of a mode at the circle, with their slopes; so large and small that they are told by |H2|.
struct Radial {
  double scale, regular, regular_slope;
  Complex outgoing, outgoing_slope;
};

Radial radial_at(double nu, double r) {
  const double j = bessel_j(nu, r), y = bessel_y(nu, r);
  const double dj = nu / r * j - bessel_j(nu + 1, r), dy = nu / r * y - bessel_y(nu + 1, r);
  const double scale = std::hypot(j, y);
  return {scale, j * scale, dj * scale, Complex(j, -y) / scale, Complex(dj, -dy) / scale};
}

// Columns: the current on the section, then outgoing modes; right sides: regular modes. Rows weighted by length.
struct System {
  Matrix left, right;
};

System system_of(const std::vector<Node>& nodes, const Layers& layers, const std::vector<Radial>& radials, double n, bool hard) {
  const auto count = static_cast<Index>(nodes.size()), half = count / 2, modes = static_cast<Index>(radials.size());
  const Index first = hard ? 0 : 1;
  Eigen::MatrixXd angular(half, modes - first);
  for (Index i = 0; i < half; ++i) {
    const double angle = std::atan2(nodes[i].position.y, nodes[i].position.x), phi = angle < 0 ? angle + 2 * pi : angle;
    for (Index m = first; m < modes; ++m)
      angular(i, m - first) = hard ? std::cos(static_cast<double>(m) / n * phi) : std::sin(static_cast<double>(m) / n * phi);
  }
  const Matrix values = layers.twofold.leftCols(half) * angular, slopes = layers.single.leftCols(half) * angular;
  System system{Matrix(count, half + modes - first), Matrix(count, modes - first)};
  system.left.leftCols(half) = hard ? layers.twofold.rightCols(half) : layers.single.rightCols(half);
  for (Index m = first; m < modes; ++m) {
    const Radial& radial = radials[m];
    system.left.col(half + m - first) = values.col(m - first) * radial.outgoing - slopes.col(m - first) * radial.outgoing_slope;
    system.right.col(m - first) = -(values.col(m - first) * radial.regular - slopes.col(m - first) * radial.regular_slope);
  }
  for (Index i = 0; i < count; ++i) {
    const double weight = std::sqrt(nodes[i].speed);
    system.left.row(i) *= weight;
    system.right.row(i) *= weight;
  }
  return system;
}

// Directions in which the columns are alike to 1e-12 are left out: modes far above kt.
Matrix least_squares(System&& system) {
  const Eigen::VectorXd scale = system.left.colwise().norm().cwiseInverse();
  system.left = system.left * scale.asDiagonal();
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposition;
  decomposition.setThreshold(1e-12);
  decomposition.compute(system.left);
  return scale.asDiagonal() * decomposition.solve(system.right);
}

ModeMatrix modes_from(const std::vector<Node>& nodes, const Layers& layers, const std::vector<Radial>& radials, double n,
                      bool hard) {
  const Matrix solved = least_squares(system_of(nodes, layers, radials, n, hard));
  const std::size_t first = hard ? 0 : 1;
  const auto norm = [](std::size_t m) { return m == 0 ? std::numbers::sqrt2 : 1.0; };
  ModeMatrix result(radials.size());
  for (std::size_t m = first; m < result.size; ++m)
    for (std::size_t q = first; q < result.size; ++q)
      result.at(m, q) = solved(static_cast<Index>(nodes.size() / 2 + m - first), static_cast<Index>(q - first)) * norm(m) /
                        (norm(q) * radials[m].scale * radials[q].scale);
  return result;
}

}  // namespace

SoftHardModes section_modes(const Section& section, double interior_angle, double tangent_distance) {
  const double n = 2 - interior_angle / pi, highest = tangent_distance + 8 + 4 * std::cbrt(tangent_distance);
  const int count = 4 * static_cast<int>(std::ceil(std::max(52.0, 4 * tangent_distance * n + 24)));
  std::vector<Radial> radials;
  for (int m = 0; m <= n * highest; ++m) radials.push_back(radial_at(m / n, tangent_distance));
  const std::vector<Node> nodes = nodes_of(section, n, tangent_distance, count);
  const Layers layers = layers_of(nodes);
  return {modes_from(nodes, layers, radials, n, false), modes_from(nodes, layers, radials, n, true)};
}

Section arc_section(double interior_angle, double tangent_distance) {
  const double end = 3 * pi / 2 - interior_angle, radius = tangent_distance * std::tan(interior_angle / 2);
  return [=](double parameter) {
    const double turn = pi / 2 - end, angle = end + turn * parameter;
    const dvec2 out(std::cos(angle), std::sin(angle)), along(-out.y, out.x), centre(tangent_distance, -radius);
    return SectionPoint{centre + radius * out, radius * turn * along, -radius * turn * turn * out};
  };
}

}  // namespace raytube
