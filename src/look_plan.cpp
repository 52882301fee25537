#include "look_plan.h"

#include <bit>
#include <map>
#include <numeric>

namespace raytube {

namespace {

// Angles of equal directions may differ in their last bits; on this lattice [degrees] those that people write have one place.
constexpr double lattice = 1e-10;
constexpr double rounding = 1e-14;  // of unit vectors from angles of up to a turn, with their conversion from degrees

using Key = std::array<long long, 4>;

long long place(double angle) {
  const auto turn = std::llround(360.0 / lattice), at = std::llround(std::remainder(angle, 2.0 * pi) / degree / lattice);
  return at < 0 ? at + turn : at == turn ? 0 : at;
}

Key key_of(const Look& look) {
  return {place(look.transmit.theta), place(look.transmit.phi), place(look.receive.theta), place(look.receive.phi)};
}

// Axes, not angles alone: at the poles they say how the polarisations lie.
bool same_to_rounding(const Direction& a, const Direction& b) {
  const SphericalBasis x = spherical_basis(a), y = spherical_basis(b);
  const auto same = [](const dvec3& p, const dvec3& q) { return glm::length(p - q) <= rounding; };
  return same(x.radial, y.radial) && same(x.theta_hat, y.theta_hat) && same(x.phi_hat, y.phi_hat);
}

Direction image(Direction d, unsigned mirrors) {
  if (mirrors & 1) d.phi = pi - d.phi;
  if (mirrors & 2) d.phi = -d.phi;
  if (mirrors & 4) d.theta = pi - d.theta;
  return d;
}

Look image(const Look& look, unsigned mirrors) { return {image(look.transmit, mirrors), image(look.receive, mirrors)}; }

class Planner {
 public:
  Planner(std::span<const Look> looks, unsigned mirrors) : looks_(looks), mirrors_(mirrors) {}

  LookPlan run() {
    for (std::size_t i = 0; i < looks_.size(); ++i)
      if (!follows(looks_[i])) add(i);
    return std::move(plan_);
  }

 private:
  // Bit a of `mirrors`: across the plane on which coordinate a is 0. None comes first.
  bool follows(const Look& look) {
    for (unsigned mirrors = 0; mirrors < 8; ++mirrors) {
      if (mirrors & ~mirrors_) continue;
      const Look wanted = image(look, mirrors);
      const auto found = known_.find(key_of(wanted));
      if (found == known_.end()) continue;
      const Look& known = looks_[plan_.computed[found->second]];
      if (!same_to_rounding(wanted.transmit, known.transmit) || !same_to_rounding(wanted.receive, known.receive)) continue;
      plan_.sources.push_back({found->second, std::popcount(mirrors) % 2 == 1});
      ++(mirrors ? plan_.mirrored : plan_.repeated);
      return true;
    }
    return false;
  }

  void add(std::size_t look) {
    known_.emplace(key_of(looks_[look]), plan_.computed.size());
    plan_.sources.push_back({plan_.computed.size()});
    plan_.computed.push_back(look);
  }

  std::span<const Look> looks_;
  unsigned mirrors_;
  std::map<Key, std::size_t> known_;  // places in the plan
  LookPlan plan_;
};

}  // namespace

LookPlan plan_all(std::size_t looks) {
  LookPlan plan;
  plan.computed.resize(looks);
  std::iota(plan.computed.begin(), plan.computed.end(), std::size_t{0});
  for (const std::size_t look : plan.computed) plan.sources.push_back({look});
  return plan;
}

LookPlan plan_looks(std::span<const Look> looks, const std::array<bool, 3>& mirror_planes) {
  const unsigned mirrors = (mirror_planes[0] ? 1u : 0u) | (mirror_planes[1] ? 2u : 0u) | (mirror_planes[2] ? 4u : 0u);
  return Planner(looks, mirrors).run();
}

ScatteringMatrix from_source(ScatteringMatrix s, const LookSource& source) {
  if (!source.mirrored) return s;
  s.at(0, 1) = -s.at(0, 1);
  s.at(1, 0) = -s.at(1, 0);
  return s;
}

}  // namespace raytube
