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

}  // namespace

const RadialBasis& RadialBasis::of_all_orders() {
  static const RadialBasis basis;
  return basis;
}

// The functions are the first columns of Q of a QR decomposition with pivoting (Businger & Golub 1965, Numer. Math. 7, 269) of
// all Green's functions: of the terms of their polynomials at the ends of the zones.
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
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(parts);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(rows, functions);
  factors_.resize(waves_.size());
  for (Eigen::Index order = 0; order < orders; ++order)
    for (const int part : {0, 1}) row(factors_[order][part]) = (q.transpose() * parts.col(part * orders + order)).array();
  for (int i = 0; i < rows; ++i)
    row(polynomials_[i / RadialWave::terms][i % RadialWave::terms]) = q.row(i).transpose() / reach[i];
}

// Around the source as RadialWave::at().
RadialBasis::Slopes RadialBasis::at(double cosine) const {
  const RadialWave::Place place = RadialWave::place(cosine);
  Slopes result;
  for (int i = 0; i < functions; i += together) {
    const auto values = [&](int polynomial) {
      std::array<Together, 3> sum{Together::Zero(), Together::Zero(), Together::Zero()};  // value, slope, half the bend
      for (int m = RadialWave::terms; m-- > 0;) {
        sum[2] = sum[2] * place.x + sum[1];
        sum[1] = sum[1] * place.x + sum[0];
        sum[0] = sum[0] * place.x + Eigen::Map<const Together>(&polynomials_[polynomial][m][i]);
      }
      return sum;
    };
    std::array<Together, 3> at = values(place.polynomial);
    if (place.near_source()) {
      const double t = place.x, log = std::log(t);
      const std::array<Together, 3> rest = values(place.polynomial + 1);
      const Together bend = at[2] * log + at[1] / t - at[0] / (2 * t * t) + rest[2];
      at[1] = -0.5 * (at[1] * log + at[0] / t + rest[1]);
      at[2] = 0.25 * bend;
    }
    Eigen::Map<Together>(&result.slope[i]) = at[1];
    Eigen::Map<Together>(&result.bend[i]) = 2.0 * at[2];
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
