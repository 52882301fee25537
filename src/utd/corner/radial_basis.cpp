#include "utd/corner/radial_basis.h"

#include <cmath>

#include "math/dense.h"
#include "utd/corner/order_nodes.h"

namespace raytube {

namespace {

// Functions that are evaluated together.
constexpr int together = 8;
using Together = Eigen::Array<double, together, 1>;
using Row = Eigen::Array<double, RadialBasis::functions, 1>;

Eigen::Map<const Row> row(const RadialBasis::PerFunction& values) { return Eigen::Map<const Row>(values.data()); }
Eigen::Map<Row> row(RadialBasis::PerFunction& values) { return Eigen::Map<Row>(values.data()); }

// The first columns of Q of a QR decomposition with pivoting (Businger & Golub 1965, Numer. Math. 7, 269), and no more of it.
Eigen::MatrixXd leading_directions(Eigen::MatrixXd columns, int count) {
  Eigen::MatrixXd q(columns.rows(), count);
  for (int i = 0; i < count; ++i) {
    Eigen::Index largest = 0;
    columns.colwise().squaredNorm().maxCoeff(&largest);
    Eigen::VectorXd direction = columns.col(largest).normalized();
    direction -= q.leftCols(i) * (q.leftCols(i).transpose() * direction);  // what rounding has left of the others
    q.col(i) = direction.normalized();
    columns -= q.col(i) * (q.col(i).transpose() * columns);
  }
  return q;
}

}  // namespace

const RadialBasis& RadialBasis::of_all_orders() {
  static const RadialBasis basis;
  return basis;
}

// The functions are the first columns of Q of a QR decomposition with pivoting of all Green's functions: of the terms of their
// polynomials at the ends of the zones.
RadialBasis::RadialBasis() {
  for (const OrderNode& node : nodes_over_orders()) waves_.emplace_back(node.nu);
  constexpr int rows = RadialWave::polynomials * RadialWave::terms;
  const auto orders = static_cast<Eigen::Index>(waves_.size());
  Eigen::VectorXd reach(rows);
  for (int i = 0; i < rows; ++i) reach[i] = std::pow(RadialWave::reach(i / RadialWave::terms), i % RadialWave::terms);
  Eigen::MatrixXd parts(rows, 2 * orders);
  for (Eigen::Index order = 0; order < orders; ++order) {
    const Eigen::Map<const Eigen::VectorXcd> terms(waves_[order].coefficients()[0].data(), rows);
    parts.col(order) = reach.cwiseProduct(terms.real());
    parts.col(orders + order) = reach.cwiseProduct(terms.imag());
  }
  const Eigen::MatrixXd q = leading_directions(parts, functions);
  factors_.resize(waves_.size());
  for (Eigen::Index order = 0; order < orders; ++order)
    for (const int part : {0, 1}) row(factors_[order][part]) = (q.transpose() * parts.col(part * orders + order)).array();
  for (int i = 0; i < rows; ++i) {
    const int polynomial = i / RadialWave::terms, power = i % RadialWave::terms;
    row(polynomials_[0][polynomial][power]) = q.row(i).transpose() / reach[i];
    if (power > 0) row(polynomials_[1][polynomial][power - 1]) = power * row(polynomials_[0][polynomial][power]);
    if (power > 1) row(polynomials_[2][polynomial][power - 2]) = (power - 1) * row(polynomials_[1][polynomial][power - 1]);
  }
}

// Around the source as RadialWave::at(). Elsewhere values are of no use.
RadialBasis::Slopes RadialBasis::at(double cosine) const {
  const RadialWave::Place place = RadialWave::place(cosine);
  Slopes result;
  for (int i = 0; i < functions; i += together) {
    const auto derivative = [&](int order, int polynomial) {
      Together sum = Together::Zero();
      for (int m = RadialWave::terms - order; m-- > 0;)
        sum = sum * place.x + Eigen::Map<const Together>(&polynomials_[order][polynomial][m][i]);
      return sum;
    };
    Together slope = derivative(1, place.polynomial), bend = derivative(2, place.polynomial);
    if (place.near_source()) {
      const double t = place.x, log = std::log(t);
      const Together value = derivative(0, place.polynomial);
      bend = 0.25 * (bend * log + 2.0 * slope / t - value / (t * t) + derivative(2, place.polynomial + 1));
      slope = -0.5 * (slope * log + value / t + derivative(1, place.polynomial + 1));
    }
    Eigen::Map<Together>(&result.slope[i]) = slope;
    Eigen::Map<Together>(&result.bend[i]) = bend;
  }
  return result;
}

void RadialSum::add(Complex factor, std::size_t order) {
  const RadialBasis::Factors& other = RadialBasis::of_all_orders().factors(order);
  row(factors_[0]) += factor.real() * row(other[0]) - factor.imag() * row(other[1]);
  row(factors_[1]) += factor.real() * row(other[1]) + factor.imag() * row(other[0]);
}

Complex RadialSum::times(const RadialBasis::PerFunction& values) const {
  return {(row(factors_[0]) * row(values)).sum(), (row(factors_[1]) * row(values)).sum()};
}

}  // namespace raytube
