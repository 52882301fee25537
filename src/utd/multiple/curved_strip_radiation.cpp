#include "utd/multiple/curved_strip_radiation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/filon.h"
#include "utd/fock/edge_factors.h"

namespace raytube {

namespace {

constexpr double soft_tip = 1.0 / 30;  // electrical length below which strips pass less soft current on

/// What a node radiates per unit of its root, for unit H and E along the edge, per receive polarisation; and what arrives there.
struct NodeCurrent {
  std::array<Complex, 2> magnetic{}, electric{};
  Complex end, soft_end;
};

NodeCurrent current_at(const StripNode& node, const StripWave& wave, double root_rate, double cube_root_of_k, Complex hard,
                       Complex axial, Complex soft) {
  const double root = root_rate * node.root;
  const EdgeFactors factors = edge_factors(cube_root_of_k * node.bend);
  const Complex area = std::polar(node.area, 0.5 * pi * node.caustics);
  const Complex across = area * factors.hard * hard * (root_rate * root);
  const Complex along = area * factors.hard * axial * (root_rate * wave.incidence.cos_cone);
  const Complex electric = area * factors.soft * soft * root_rate;
  NodeCurrent current;
  for (int p = 0; p < 2; ++p) {
    current.magnetic[p] = across * node.across[p] + along * node.along[p];
    current.electric[p] = electric * node.along[p];
  }
  current.end = Complex(0, 1) * area * factors.hard * hard;
  current.soft_end = root > 0.0 ? Complex(0, 1 / root) * area * factors.soft * soft : 0.0;
  return current;
}

/// Integrals over a piece of a strip, for unit H and E along its edge.
struct StripIntegral {
  std::array<Complex, 2> magnetic{}, electric{};

  void add_step(const NodeCurrent& a, const NodeCurrent& b, double step, double phase_a, double phase_b) {
    const FilonStep filon = filon_step(phase_a, phase_b);
    const Complex even = step * filon.even, odd = step * filon.odd;
    for (int p = 0; p < 2; ++p) {
      magnetic[p] += even * (a.magnetic[p] + b.magnetic[p]) + odd * (b.magnetic[p] - a.magnetic[p]);
      electric[p] += even * (a.electric[p] + b.electric[p]) + odd * (b.electric[p] - a.electric[p]);
    }
  }

  void add_kernels(const StripPath& path, const FringeKernels& kernels, double share) {
    for (int p = 0; p < 2; ++p) {
      magnetic[p] += share * (kernels.hard * path.projection.across[p] +
                              path.wave.incidence.cos_cone * kernels.axial * path.projection.along[p]);
      electric[p] += share * kernels.soft * path.projection.along[p];
    }
  }
};

/// What arrives at the end of a strip, for unit H and E along its edge.
struct StripEnd {
  Complex hard, soft;
};

/// A strip at one wavenumber, bin after bin of the paths along it.
class StripSumInBins {
 public:
  StripSumInBins(const StripStart& start, std::size_t node, PathBins& bins)
      : start_(start), node_(node), bins_(bins), wavenumber_(bins.nodes()[node]) {}

  StripEnd add(const StripPath& path) {
    const StripEnd end = path.nodes.empty() ? add_flat(path) : add_curved(path);
    put();
    return end;
  }

 private:
  /// The integral to which waves of a path belong, from the strip's start.
  StripIntegral& at(double path) {
    const double whole = start_.path + path;
    if (path_ && bins_.key(whole) != bins_.key(*path_)) put();
    path_ = whole;
    return sum_;
  }

  void put() {
    ScatteringMatrix& s = bins_.at(bins_.find(*path_), node_);
    for (int receive = 0; receive < 2; ++receive)
      for (int transmit = 0; transmit < 2; ++transmit)
        s.at(receive, transmit) +=
            sum_.magnetic[receive] * start_.magnetic[transmit] + sum_.electric[receive] * start_.electric[transmit];
    sum_ = {};
  }

  StripEnd add_curved(const StripPath& path) {
    const double k = wavenumber_, rate = std::sqrt(2 * k) * path.wave.incidence.sin_cone, cube_root_of_k = std::cbrt(k);
    NodeCurrent before;
    for (std::size_t first = 0; first < path.nodes.size(); first += lanes) {
      const std::size_t count = std::min(lanes, path.nodes.size() - first);
      Reals root;
      for (std::size_t i = 0; i < lanes; ++i) root[i] = rate * path.nodes[first + std::min(i, count - 1)].root;
      const Strip::Currents currents = path.strip.currents(root);
      for (std::size_t i = 0; i < count; ++i) {
        const StripNode& node = path.nodes[first + i];
        const NodeCurrent here = current_at(node, path.wave, rate, cube_root_of_k, currents.hard[i], currents.axial[i], currents.soft[i]);
        if (first + i > 0) {
          const StripNode& last = path.nodes[first + i - 1];
          at(0.5 * (last.path + node.path)).add_step(before, here, node.root - last.root, k * last.path, k * node.path);
        }
        before = here;
      }
    }
    const double length = 0.5 * std::pow(rate * path.nodes.back().root, 2);
    at(0.0).add_kernels(path, path.strip.local_part(), -std::expm1(-length));
    const Complex phase = std::polar(1.0, k * path.nodes.back().path);
    return {phase * before.end, phase * before.soft_end * -std::expm1(-length / soft_tip)};
  }

  StripEnd add_flat(const StripPath& path) {
    KernelBatch batch;
    const double length = wavenumber_ * path.length * path.wave.incidence.sin_cone * path.wave.incidence.sin_cone;
    path.strip.at(std::span(&length, 1), batch);
    const StripKernels kernels = batch[0];
    if (std::isinf(length) || std::abs(path.end_path()) <= 2.0 * bins_.spread()) {
      at(std::isinf(length) ? 0.0 : 0.5 * path.end_path()).add_kernels(path, kernels.current, 1.0);
    } else {
      path.strip.start_parts(std::span(&length, 1), batch);
      const FringeKernels start = batch[0].current;
      at(0.0).add_kernels(path, start, 1.0);
      at(path.end_path()).add_kernels(path, kernels.current, 1.0);
      sum_.add_kernels(path, start, -1.0);
    }
    return {kernels.end, kernels.soft_end};
  }

  const StripStart& start_;
  std::size_t node_;
  PathBins& bins_;
  double wavenumber_;
  std::optional<double> path_{};  // of what was added last
  StripIntegral sum_;
};

}  // namespace

void radiate(const StripPath& path, std::size_t node, const StripStart& start, PathBins& own, PathBins& further) {
  if (path.length <= 0.0) return;
  const StripEnd end = StripSumInBins(start, node, own).add(path);
  if (path.next.empty()) return;
  StripStart next{};
  next.path = start.path + path.end_path();
  for (int transmit = 0; transmit < 2; ++transmit)
    next.magnetic[transmit] = start.magnetic[transmit] * end.hard + start.lying[transmit] * end.soft;
  for (const StripPath& each : path.next) radiate(each, node, next, further, further);
}

}  // namespace raytube
