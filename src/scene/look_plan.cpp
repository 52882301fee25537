#include "scene/look_plan.h"

#include <bit>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace raytube {

namespace {

// Angles of equal directions may differ in their last bits; on this lattice [degrees] those that people write have one index.
constexpr double lattice = 1e-10;
constexpr double rounding = 1e-14;  // of unit vectors from angles of up to a turn, with their conversion from degrees

constexpr long long turn = 3'600'000'000'000;  // in steps of the lattice

// theta, phi of the transmitter, then of the receiver, in steps of the lattice, 0 to a turn.
using Key = std::array<long long, 4>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const long long index : key)
      hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio
    return hash ^ (hash >> 32);
  }
};

long long within_turn(long long index) { return ((index % turn) + turn) % turn; }

long long index_of(double angle) { return within_turn(std::llround(std::remainder(angle, 2.0 * pi) / degree / lattice)); }

Key key_of(const Look& look) {
  return {index_of(look.transmit.theta), index_of(look.transmit.phi), index_of(look.receive.theta), index_of(look.receive.phi)};
}

// Bit a of `planes`: across the plane on which coordinate a is 0.
Key image(Key key, unsigned planes) {
  for (const int theta : {0, 2}) {
    const int phi = theta + 1;
    if (planes & 1) key[phi] = turn / 2 - key[phi];
    if (planes & 2) key[phi] = -key[phi];
    if (planes & 4) key[theta] = turn / 2 - key[theta];
    key[phi] = within_turn(key[phi]), key[theta] = within_turn(key[theta]);
  }
  return key;
}

// Axes, not angles alone: at the poles they say how the polarisations lie.
bool same_to_rounding(const Direction& a, const Direction& b) {
  const SphericalBasis x = spherical_basis(a), y = spherical_basis(b);
  const auto same = [](const dvec3& p, const dvec3& q) { return glm::length(p - q) <= rounding; };
  return same(x.radial, y.radial) && same(x.theta_hat, y.theta_hat) && same(x.phi_hat, y.phi_hat);
}

Direction image(Direction d, unsigned planes) {
  if (planes & 1) d.phi = pi - d.phi;
  if (planes & 2) d.phi = -d.phi;
  if (planes & 4) d.theta = pi - d.theta;
  return d;
}

Look image(const Look& look, unsigned planes) { return {image(look.transmit, planes), image(look.receive, planes)}; }

}  // namespace

LookPlan plan_all(std::size_t looks) {
  LookPlan plan;
  plan.computed.resize(looks);
  std::iota(plan.computed.begin(), plan.computed.end(), std::size_t{0});
  for (const std::size_t look : plan.computed) plan.sources.push_back({look});
  return plan;
}

LookPlan plan_looks(std::span<const Look> looks, const std::array<bool, 3>& symmetry_planes) {
  const unsigned mirrors = (symmetry_planes[0] ? 1u : 0u) | (symmetry_planes[1] ? 2u : 0u) | (symmetry_planes[2] ? 4u : 0u);
  std::unordered_map<Key, std::size_t, KeyHash> known;  // indices in the plan
  LookPlan plan;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const Key key = key_of(looks[i]);
    bool follows = false;
    for (unsigned planes = 0; planes < 8 && !follows; ++planes) {  // no reflection comes first
      if (planes & ~mirrors) continue;
      const auto found = known.find(image(key, planes));
      if (found == known.end()) continue;
      const Look wanted = image(looks[i], planes);
      const Look& source = looks[plan.computed[found->second]];
      if (!same_to_rounding(wanted.transmit, source.transmit) || !same_to_rounding(wanted.receive, source.receive)) continue;
      plan.sources.push_back({found->second, std::popcount(planes) % 2 == 1});
      ++(planes ? plan.mirrored : plan.repeated);
      follows = true;
    }
    if (follows) continue;
    known.emplace(key, plan.computed.size());
    plan.sources.push_back({plan.computed.size()});
    plan.computed.push_back(i);
  }
  return plan;
}

ScatteringMatrix from_source(ScatteringMatrix s, const LookSource& source) {
  if (!source.mirrored) return s;
  s.at(0, 1) = -s.at(0, 1);
  s.at(1, 0) = -s.at(1, 0);
  return s;
}

}  // namespace raytube
