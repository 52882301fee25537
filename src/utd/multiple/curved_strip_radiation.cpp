#include "utd/multiple/curved_strip_radiation.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "math/filon.h"
#include "utd/fock/edge_factors.h"

namespace raytube {

namespace {

constexpr double soft_tip = 1.0 / 30;  // electrical length below which strips pass less soft current on

/// At a node, what the strip's currents and its curvature and width make of unit waves; `root` is that of its electrical length.
struct NodeCurrent {
  double root;
  Complex hard, axial, soft;
};

NodeCurrent current_at(const StripNode& node, double root, double xi, Complex hard, Complex axial, Complex soft) {
  constexpr Complex quarter_turns[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const EdgeFactors factors = edge_factors(xi);
  const Complex area = node.area * quarter_turns[node.caustics % 4], of_hard = area * factors.hard;
  return {root, of_hard * hard, of_hard * axial, area * factors.soft * soft};
}

/// Integrals over a piece of a strip, for unit H and E along its edge, per receive polarisation.
struct StripIntegral {
  std::array<Complex, 2> magnetic{}, electric{};

  void add_node(const StripNode& node, const NodeCurrent& current, double cos_cone, Complex weight) {
    const Complex hard = current.root * weight * current.hard, axial = cos_cone * weight * current.axial;
    const Complex soft = weight * current.soft;
    for (int p = 0; p < 2; ++p) {
      magnetic[p] += hard * node.across[p] + axial * node.along[p];
      electric[p] += soft * node.along[p];
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
  /// Whether waves of a path from the strip's start belong to what is summed.
  bool belongs(double path) const { return !path_ || bins_.key(start_.path + path) == bins_.key(*path_); }

  /// The integral to which they do.
  StripIntegral& at(double path) {
    if (!belongs(path)) put();
    path_ = start_.path + path;
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
    const double cos_cone = path.wave.incidence.cos_cone;
    NodeCurrent last{};
    Complex phase, weight;  // of the last node, and by the steps before it
    for (std::size_t first = 0; first < path.nodes.size(); first += lanes) {
      const std::size_t count = std::min(lanes, path.nodes.size() - first);
      Reals root, angle;
      for (std::size_t i = 0; i < lanes; ++i) {
        const StripNode& node = path.nodes[first + std::min(i, count - 1)];
        root[i] = rate * node.root, angle[i] = k * node.path;
      }
      const Strip::Currents currents = path.strip.currents(root);
      const Complexes phases = unit_phasors(angle);
      for (std::size_t i = 0; i < count; ++i) {
        const StripNode& node = path.nodes[first + i];
        const NodeCurrent here =
            current_at(node, root[i], cube_root_of_k * node.bend, currents.hard[i], currents.axial[i], currents.soft[i]);
        if (first + i > 0) {
          const StripNode& before = path.nodes[first + i - 1];
          const FilonStep filon = filon_step(k * before.path, angle[i], phase, phases[i]);
          const double step = root[i] - last.root;
          const double middle = 0.5 * (before.path + node.path);
          if (!belongs(middle)) {
            sum_.add_node(before, last, cos_cone, std::exchange(weight, 0.0));
            put();
          }
          path_ = start_.path + middle;
          sum_.add_node(before, last, cos_cone, weight + step * (filon.even - filon.odd));
          weight = step * (filon.even + filon.odd);
        }
        last = here, phase = phases[i];
      }
    }
    sum_.add_node(path.nodes.back(), last, cos_cone, weight);
    const double length = 0.5 * last.root * last.root;
    at(0.0).add_kernels(path, path.strip.local_part(), -std::expm1(-length));
    const Complex end = Complex(0, 1) * phase;
    return {end * last.hard, last.root > 0.0 ? end * last.soft * (-std::expm1(-length / soft_tip) / last.root) : 0.0};
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
