#include "utd/fock/impedance_fock.h"

#include <cmath>
#include <span>
#include <vector>

#include "math/lanes.h"
#include "utd/fock/fock_contours.h"

namespace raytube {

namespace {

// Some points of a contour.
struct Block {
  Reals along{}, across{};  // Re tau, Im tau
  Complexes weight{}, value{}, slope{};
};

std::vector<Block> blocks_of(std::span<const fock_contours::Point> points) {
  std::vector<Block> blocks((points.size() + lanes - 1) / lanes);
  for (std::size_t i = 0; i < blocks.size() * lanes; ++i) {
    Block& block = blocks[i / lanes];
    const std::size_t lane = i % lanes;
    const fock_contours::Point point = i < points.size() ? points[i] : fock_contours::Point{0.0, 0.0, 1.0, 1.0};
    block.along[lane] = point.tau.real(), block.across[lane] = point.tau.imag();
    block.weight.set(lane, point.weight), block.value.set(lane, point.value), block.slope.set(lane, point.slope);
  }
  return blocks;
}

// weight e^{-j xi tau}
Complexes waves(const Block& block, double xi) {
  Reals phase;
  for (std::size_t i = 0; i < lanes; ++i) phase[i] = -xi * block.along[i];
  Complexes wave = unit_phasors(phase);
  for (std::size_t i = 0; i < lanes; ++i) {
    const double size = std::exp(xi * block.across[i]), re = wave.re[i], im = wave.im[i];
    wave.re[i] = size * (block.weight.re[i] * re - block.weight.im[i] * im);
    wave.im[i] = size * (block.weight.re[i] * im + block.weight.im[i] * re);
  }
  return wave;
}

// Adds wave / (a W' + b W).
void add(const Complexes& wave, const Block& block, const Complex& a, const Complex& b, Complexes& sum) {
  const double ar = a.real(), ai = a.imag(), br = b.real(), bi = b.imag();
  for (std::size_t i = 0; i < lanes; ++i) {
    const double re = ar * block.slope.re[i] - ai * block.slope.im[i] + br * block.value.re[i] - bi * block.value.im[i];
    const double im = ar * block.slope.im[i] + ai * block.slope.re[i] + br * block.value.im[i] + bi * block.value.re[i];
    const double over = 1.0 / (re * re + im * im);
    sum.re[i] += over * (wave.re[i] * re + wave.im[i] * im);
    sum.im[i] += over * (wave.im[i] * re - wave.re[i] * im);
  }
}

Complex total(const Complexes& sums) {
  Complex result = 0.0;
  for (std::size_t i = 0; i < lanes; ++i) result += sums[i];
  return result;
}

}  // namespace

FockCurrents impedance_fock(double xi, double m, const FaceImpedance& impedance) {
  static const std::vector<Block> dark = blocks_of(fock_contours::dark), lit = blocks_of(fock_contours::lit);
  Complexes hard{}, soft{};
  for (const Block& block : xi < 0.0 ? lit : dark) {
    const Complexes wave = waves(block, xi);
    add(wave, block, 1.0, Complex(0.0, m) * impedance.hard, hard);
    add(wave, block, impedance.soft / m, Complex(0.0, 1.0), soft);
  }
  return {total(hard), total(soft)};
}

}  // namespace raytube
