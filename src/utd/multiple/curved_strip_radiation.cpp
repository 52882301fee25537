#include "utd/multiple/curved_strip_radiation.h"

#include <algorithm>
#include <cmath>

#include "math/filon.h"
#include "utd/surface/edge_factors.h"

namespace raytube {

namespace {

constexpr double soft_tip = 1.0 / 30;  // electrical length below which strips pass less soft current on

/// What a node radiates per unit of its root, for unit H and E along the edge, per receive polarisation; and what arrives there.
struct NodeCurrent {
  std::array<Complex, 2> magnetic{}, electric{};
  Complex end, soft_end;
};

NodeCurrent current_at(const StripNode& node, const StripWave& wave, double k, Complex hard, Complex axial, Complex soft) {
  const double sine = wave.incidence.sin_cone, root_rate = std::sqrt(2 * k) * sine, root = root_rate * node.root;
  const EdgeFactors factors = edge_factors(std::cbrt(k) * node.bend);
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

/// The integrals over a strip, for unit H and E along its edge.
struct StripIntegral {
  std::array<Complex, 2> magnetic{}, electric{};
  Complex end, soft_end;

  void add_step(const NodeCurrent& a, const NodeCurrent& b, double step, double phase_a, double phase_b) {
    const FilonStep filon = filon_step(phase_a, phase_b);
    const Complex even = step * filon.even, odd = step * filon.odd;
    for (int p = 0; p < 2; ++p) {
      magnetic[p] += even * (a.magnetic[p] + b.magnetic[p]) + odd * (b.magnetic[p] - a.magnetic[p]);
      electric[p] += even * (a.electric[p] + b.electric[p]) + odd * (b.electric[p] - a.electric[p]);
    }
  }

  void add_local(const StripPath& path, double reached) {
    const FringeKernels local = path.strip.local_part();
    for (int p = 0; p < 2; ++p) {
      magnetic[p] += reached * (local.hard * path.projection.across[p] +
                                path.wave.incidence.cos_cone * local.axial * path.projection.along[p]);
      electric[p] += reached * local.soft * path.projection.along[p];
    }
  }
};

StripIntegral over_curved(const StripPath& path, double k) {
  StripIntegral sum;
  const double rate = std::sqrt(2 * k) * path.wave.incidence.sin_cone;
  NodeCurrent before;
  for (std::size_t first = 0; first < path.nodes.size(); first += lanes) {
    const std::size_t count = std::min(lanes, path.nodes.size() - first);
    Reals root;
    for (std::size_t i = 0; i < lanes; ++i) root[i] = rate * path.nodes[first + std::min(i, count - 1)].root;
    const Strip::Currents currents = path.strip.currents(root);
    for (std::size_t i = 0; i < count; ++i) {
      const StripNode& node = path.nodes[first + i];
      const NodeCurrent here = current_at(node, path.wave, k, currents.hard[i], currents.axial[i], currents.soft[i]);
      if (first + i > 0) {
        const StripNode& last = path.nodes[first + i - 1];
        sum.add_step(before, here, node.root - last.root, k * last.path, k * node.path);
      }
      before = here;
    }
  }
  const double length = 0.5 * std::pow(rate * path.nodes.back().root, 2);
  sum.add_local(path, -std::expm1(-length));
  const Complex phase = std::polar(1.0, k * path.nodes.back().path);
  sum.end = phase * before.end;
  sum.soft_end = phase * before.soft_end * -std::expm1(-length / soft_tip);
  return sum;
}

StripIntegral over_flat(const StripPath& path, double k) {
  KernelBatch batch;
  const double length = k * path.length * path.wave.incidence.sin_cone * path.wave.incidence.sin_cone;
  path.strip.at(std::span(&length, 1), batch);
  const StripKernels kernels = batch[0];
  StripIntegral sum;
  for (int p = 0; p < 2; ++p) {
    sum.magnetic[p] = kernels.current.hard * path.projection.across[p] +
                      path.wave.incidence.cos_cone * kernels.current.axial * path.projection.along[p];
    sum.electric[p] = kernels.current.soft * path.projection.along[p];
  }
  sum.end = kernels.end;
  sum.soft_end = kernels.soft_end;
  return sum;
}

}  // namespace

void radiate(const StripPath& path, double wavenumber, const StripStart& start, ScatteringMatrix& own,
             ScatteringMatrix& further) {
  if (path.length <= 0.0) return;
  const StripIntegral sum = path.nodes.empty() ? over_flat(path, wavenumber) : over_curved(path, wavenumber);
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit)
      own.at(receive, transmit) +=
          sum.magnetic[receive] * start.magnetic[transmit] + sum.electric[receive] * start.electric[transmit];
  if (path.next.empty()) return;
  StripStart next{};
  for (int transmit = 0; transmit < 2; ++transmit)
    next.magnetic[transmit] = start.magnetic[transmit] * sum.end + start.lying[transmit] * sum.soft_end;
  for (const StripPath& each : path.next) radiate(each, wavenumber, next, further, further);
}

}  // namespace raytube
