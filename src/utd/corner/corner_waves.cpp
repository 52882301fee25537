#include "utd/corner/corner_waves.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "math/erfc_ray.h"
#include "math/smooth_step.h"
#include "utd/corner/along_edge.h"
#include "utd/corner/corner_angles.h"
#include "utd/corner/wedge_ends.h"

namespace raytube {

namespace {

constexpr double least_weight = 1e-9;

bool is_half_plane(const Wedge& wedge) { return wedge.radiates() && std::abs(wedge.n - 2.0) < 1e-9; }

// A wave along an edge of length L spreads to sqrt(L/k) across it, as one whose rays are 1 / sqrt(kL) off it; to these a body of
// thickness t is t / sqrt(kL) thick. Up to the limit of thin plates, lambda / 10, it is a sheet, at twice that it is none.
double sheet_share(double thickness, double wavenumber, double length) {
  const double tenths = 10.0 * thickness / (2.0 * pi / wavenumber * std::sqrt(wavenumber * length));
  return smooth_step(2.0 - tenths);
}

// The edge of a plate of thickness t acts as that of a half plane which ends so much further out, t (ln(1/kappa) + 1 - gamma) /
// 2 pi with kappa = t sin(beta') / lambda: the real part of the first order of docs/theory/edges.md#thin-plates.
double edge_shift(double thickness, double wavenumber, double length) {
  if (thickness <= 0.0) return 0.0;
  const double kappa = thickness * wavenumber / (2.0 * pi * std::sqrt(wavenumber * length));
  return thickness / (2.0 * pi) * (1.0 - std::numbers::egamma - std::log(kappa));
}

}  // namespace

/// Looks for the corners between which edges run.
class CornerWaves::Finder {
 public:
  explicit Finder(std::span<const Wedge> wedges) : wedges_(wedges), ends_(wedges) {}

  /// The edge that a wedge is a part of, if it has a corner at both ends; without the corners' solutions.
  std::optional<Edge> edge(std::uint32_t index) {
    if (!is_half_plane(wedges_[index])) return std::nullopt;
    Edge edge{.ends = {}, .length = wedges_[index].length(), .part = 1.0, .first = index};
    const auto start = follow(2 * index, edge.length), finish = start ? follow(2 * index + 1, edge.length) : std::nullopt;
    if (!finish || angle_between(ends_.direction(*start), ends_.direction(*finish)) < greatest_corner) return std::nullopt;
    for (const std::uint32_t side : {0u, 1u}) {
      const auto end = corner(side == 0 ? *start : *finish, wedges_[index].faces[0].normal);
      if (!end) return std::nullopt;
      edge.ends[side] = *end;
    }
    edge.part = wedges_[index].share * wedges_[index].length() / edge.length;
    return edge;
  }

 private:
  /// The end that meets this one, if it is a half plane's and the only one.
  std::optional<std::uint32_t> met_by(std::uint32_t end) {
    const Wedge& wedge = wedges_[end / 2];
    const double distance = 1e-9 * wedge.length() + 2 * wedge.thickness();
    const auto met = ends_.met_by(end, distance);
    return met.size() == 1 && is_half_plane(ends_.wedge(met[0])) ? std::optional(met[0]) : std::nullopt;
  }

  /// Over ends where the edge goes on nearly straight to the last one; adds what lies between to `length`, or up to where it
  /// bends too far.
  std::optional<std::uint32_t> follow(std::uint32_t end, double& length) {
    const dvec3 first = ends_.direction(end);
    while (true) {
      const auto next = met_by(end);
      if (!next) return std::nullopt;
      if (angle_between(ends_.direction(*next), ends_.direction(end)) <= greatest_corner) return end;
      end = *next ^ 1u;
      if (angle_between(ends_.direction(end), first) > pi - greatest_corner) return std::nullopt;
      length += wedges_[end / 2].length();
    }
  }

  /// The corner there; `normal` is the sheet's.
  std::optional<End> corner(std::uint32_t end, const dvec3& normal) {
    const auto flat = [&](const dvec3& v) { return glm::normalize(v - glm::dot(v, normal) * normal); };
    const std::uint32_t beside = *met_by(end);
    const dvec3 met = ends_.direction(beside), edge = flat(ends_.direction(end)), other = flat(met);
    const double angle = angle_between(edge, other);
    if (angle < least_corner || angle > greatest_corner) return std::nullopt;
    if (glm::dot(wedges_[end / 2].faces[0].into_face, other) <= 0 || std::abs(glm::dot(normal, met)) > off_plane)
      return std::nullopt;
    const dvec3 bisector = glm::normalize(edge + other), along = glm::normalize(edge - glm::dot(edge, bisector) * bisector);
    const double side = glm::dot(glm::cross(bisector, along), normal) < 0 ? -1.0 : 1.0;
    double other_length = wedges_[beside / 2].length();
    follow(beside ^ 1u, other_length);
    return End{ends_.position(end), bisector, along, normal, side, edge, other, other_length};
  }

  std::span<const Wedge> wedges_;
  WedgeEnds ends_;
};

CornerWaves::CornerWaves(std::span<const Wedge> wedges, const CornerWaveOptions& kinds)
    : edges_(wedges.size()), solids_(wedges), kinds_(wedges.size()) {
  Finder finder(wedges);
  std::vector<std::uint32_t> longest_first;
  for (std::uint32_t i = 0; i < wedges.size(); ++i)
    if (const std::optional<Edge> edge = finder.edge(i)) edges_[i] = std::make_unique<Edge>(*edge);
  find_thin(wedges);
  for (std::uint32_t i = 0; i < wedges.size(); ++i)
    if (edges_[i]) longest_first.push_back(i);
  std::ranges::stable_sort(longest_first, std::ranges::greater{}, [&](std::uint32_t i) { return edges_[i]->length; });
  for (const std::uint32_t i : longest_first)
    for (End& end : edges_[i]->ends)
      if (edges_[i] && !(end.angle = angle_of(rounded_corner(angle_between(end.edge, end.other_edge))))) {
        edges_[i].reset();
        break;
      }
  // What an edge is hangs on no switch.
  const auto wanted = [&](CornerWaveKind kind) {
    return kind == CornerWaveKind::plate ? kinds.plates : kind == CornerWaveKind::thin_end ? kinds.thin_ends : kinds.solids;
  };
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    if (edges_[i]) kinds_[i] = edges_[i]->kind;
    if (!edges_[i] && solids_[i]) kinds_[i] = CornerWaveKind::solid;
    if (kinds_[i] && !wanted(*kinds_[i])) kinds_[i].reset();
  }
}

void CornerWaves::find_thin(std::span<const Wedge> wedges) {
  const std::vector<ThinEnd> ends = find_thin_ends(wedges);
  for (const ThinEnd& end : ends) {
    put_end(wedges, end);
    for (const int tip : {0, 1}) put_sharp_edge(wedges, end, tip, ends);
  }
}

/// The corner at a tip for the waves along one of its edges; none between edges that are nearly one.
std::optional<CornerWaves::End> CornerWaves::corner_at(const ThinEnd& thin, int tip, bool along_sharp) {
  const ThinEnd::Tip& here = thin.tips[tip];
  const dvec3 across = glm::normalize(thin.tips[1 - tip].position - here.position);
  const double angle = angle_between(across, here.sharp);
  if (angle < least_corner || angle > greatest_corner) return std::nullopt;
  const dvec3 &edge = along_sharp ? here.sharp : across, &other = along_sharp ? across : here.sharp;
  const dvec3 bisector = glm::normalize(edge + other), along = glm::normalize(edge - glm::dot(edge, bisector) * bisector);
  const dvec3 normal = glm::normalize(glm::cross(bisector, along));
  return End{here.position, bisector, along, normal, 1.0, edge, other, along_sharp ? thin.length() : here.sharp_length};
}

/// One normal for both.
std::optional<std::array<CornerWaves::End, 2>> CornerWaves::both(std::optional<End> first, std::optional<End> last) {
  if (!first || !last) return std::nullopt;
  if (glm::dot(first->normal, last->normal) < 0.0) last->normal = -last->normal, last->side = -1.0;
  return std::array{*first, *last};
}

void CornerWaves::put_end(std::span<const Wedge> wedges, const ThinEnd& thin) {
  const auto ends = both(corner_at(thin, 0, false), corner_at(thin, 1, false));
  if (!ends) return;
  for (const int side : {0, 1}) {
    double length = 0.0;
    for (const std::uint32_t w : thin.sides[side]) length += wedges[w].length();
    for (const std::uint32_t w : thin.sides[side])
      edges_[w] = std::make_unique<Edge>(Edge{*ends, thin.length(), wedges[w].length() / length, CornerWaveKind::thin_end,
                                              thin.sides[0][0], thin.thickness, thin.outwards, thin.towards[side]});
  }
}

/// Between two thin ends; found from both of them.
void CornerWaves::put_sharp_edge(std::span<const Wedge> wedges, const ThinEnd& thin, int tip, std::span<const ThinEnd> all) {
  const ThinEnd::Tip& here = thin.tips[tip];
  for (const ThinEnd& other : all)
    for (const int there : {0, 1}) {
      if (other.tips[there].position != here.sharp_end || edges_[here.edges.front()]) continue;
      const auto ends = both(corner_at(thin, tip, true), corner_at(other, there, true));
      if (!ends) continue;
      for (const std::uint32_t w : here.edges)
        edges_[w] = std::make_unique<Edge>(Edge{.ends = *ends,
                                                .length = here.sharp_length,
                                                .part = wedges[w].length() / here.sharp_length,
                                                .kind = CornerWaveKind::thin_end,
                                                .first = here.edges.front()});
    }
}

std::size_t CornerWaves::count(CornerWaveKind kind) const {
  return static_cast<std::size_t>(std::ranges::count(kinds_, std::optional(kind)));
}

std::size_t CornerWaves::bytes(CornerWaveKind kind) const {
  if (count(kind) == 0) return 0;
  if (kind == CornerWaveKind::solid) return solids_.bytes();
  std::set<const Angle*> used;
  for (std::uint32_t i = 0; i < edges_.size(); ++i)
    for (int end = 0; kinds_[i] == kind && end < 2; ++end) used.insert(edges_[i]->ends[end].angle);
  return used.size() * SheetCorner::bytes();
}

double CornerWaves::Edge::length_weight(double wavenumber) const { return sheet_share(thickness, wavenumber, length); }

double CornerWaves::part(std::uint32_t wedge, const dvec3& incident) const {
  if (!edges_[wedge]) return 1.0;
  const double from_beyond = glm::dot(incident, edges_[wedge]->towards);
  return edges_[wedge]->part * (from_beyond == 0.0 && edges_[wedge]->thickness > 0.0 ? 0.5 : from_beyond > 0.0 ? 0.0 : 1.0);
}

const CornerWaves::Angle* CornerWaves::angle_of(double angle) {
  const auto known = std::ranges::find_if(angles_, [&](const auto& a) { return a->value() == angle; });
  if (known != angles_.end()) return known->get();
  if (angles_.size() == most_angles) return nullptr;
  return angles_.emplace_back(std::make_unique<Angle>(angle)).get();
}

const SheetCorner& CornerWaves::Angle::corner() const {
  std::call_once(once_, [this] { corner_.emplace(angle_); });
  return *corner_;
}

CornerWaves::Passage CornerWaves::End::passage(const dvec3& towards, const std::array<dvec3, 2>& fields) const {
  const auto local = [&](const dvec3& v) { return dvec3(glm::dot(v, bisector), glm::dot(v, along), side * glm::dot(v, normal)); };
  const SheetCorner::Start wave = angle->corner().start(local(towards));
  Passage result{*this, towards};
  for (int q = 0; q < 2; ++q) {
    result.flat[q] = dot(wave.flat, local(fields[q]));
    result.upright[q] = dot(wave.upright, local(fields[q]));
  }
  return result;
}

std::array<Complex, 2> CornerWaves::Passage::at(double electrical_length) const {
  const Complex factor = upright_factor(end, towards, electrical_length);
  return {flat[0] + factor * upright[0], flat[1] + factor * upright[1]};
}

// E upright on the sheet: a wave that grazes it on its way to a corner behind it has one sign above and the other below, and an
// endless sheet keeps them apart. Over a sheet as long as the edge they meet again, as over any edge, and edge-on nothing is
// left. Where the way runs along one of the corner's own edges they meet beside it.
Complex CornerWaves::upright_factor(const End& end, const dvec3& towards, double electrical_length) {
  double behind = 1.0;
  for (const auto& [edge, other] : {std::pair(end.edge, end.other_edge), std::pair(end.other_edge, end.edge)}) {
    const double inside = glm::dot(towards, glm::normalize(other - glm::dot(other, edge) * edge));
    if (inside <= 0.0) return 1.0;
    behind *= -std::expm1(-electrical_length * inside * inside);
  }
  const double height = glm::dot(towards, end.normal), detour = height * height / (1.0 + std::sqrt(1.0 - height * height));
  const double squared = electrical_length * detour / behind;
  if (!(squared < 1e12)) return 1.0;
  return 1.0 - std::polar(1.0, -squared) * scaled_erfc(std::sqrt(squared));
}

// The wave of one edge of the corner, diffracted to run along the other, is among the strips; so is what follows. It runs there
// if the edge has the source on the cone on which the other edge lies: `off_cone` is the angle off that. Nor does a corner send a
// plane wave where one of its edges points to, `off_edge` away; and between edges of a fraction of a wavelength it is none.
double CornerWaves::End::weight(const dvec3& towards, double wavenumber, double length) const {
  const double other = wavenumber * other_length;
  double product = -std::expm1(-other * other);
  for (const dvec3& one : {edge, other_edge}) {
    const double off_edge = angle_between(towards, one), off_cone = off_edge + angle->value() - pi;
    for (const double off : {off_edge, off_cone}) product *= -std::expm1(-wavenumber * length * off * off);
  }
  return product;
}

// Both ways, from the transmitter over one end and the other one to the receiver. An edge has at its ends `weight`, which hangs
// on the wavelength, and `passage`, the part of a wave there that both fields of an antenna have.
template <class AnyEdge>
void CornerWaves::add_both_ways(const AnyEdge& edge, double share, const std::array<Visit, 2>& visits,
                                std::span<const double> frequencies, std::span<ScatteringMatrix> sum) {
  const auto weight = [&](int from, double k) {
    return edge.ends[from].weight(-visits[from].look.incident, k, edge.length) *
           edge.ends[1 - from].weight(visits[1 - from].look.scattered, k, edge.length) * edge.length_weight(k);
  };
  const auto matters = [&](double f) {
    return weight(0, wavenumber(f)) >= least_weight || weight(1, wavenumber(f)) >= least_weight;
  };
  if (std::ranges::none_of(frequencies, matters)) return;
  const auto sent_at = [&](int end) { return edge.ends[end].passage(-visits[end].look.incident, visits[end].look.electric); };
  const auto received_at = [&](int end) { return edge.ends[end].passage(visits[end].look.scattered, visits[end].look.receive); };
  const auto is_back = [](const Visit& at) {
    return at.look.scattered == -at.look.incident && at.look.receive == at.look.electric;
  };
  const std::array sent{sent_at(0), sent_at(1)};
  const std::array received = std::ranges::all_of(visits, is_back) ? sent : std::array{received_at(0), received_at(1)};
  for (std::size_t f = 0; f < frequencies.size(); ++f)
    for (const int from : {0, 1}) {
      const double k = wavenumber(frequencies[f]), path = visits[from].in + visits[1 - from].out;
      const double further_out = glm::dot(visits[1 - from].look.scattered - visits[from].look.incident, edge.outwards);
      const double phase = k * (path + further_out * edge_shift(edge.thickness, k, edge.length));
      const Complex factor = along_edge(edge.n, edge.length, k) * std::polar(share * weight(from, k), phase);
      const std::array<Complex, 2> starts = sent[from].at(k * edge.length), leaves = received[1 - from].at(k * edge.length);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) sum[f].at(p, q) += factor * leaves[p] * starts[q];
    }
}

std::array<dvec3, 2> CornerWaves::corners_of(std::uint32_t wedge) const {
  const auto positions = [](const auto& edge) { return std::array{edge.ends[0].position, edge.ends[1].position}; };
  return edges_[wedge] ? positions(*edges_[wedge]) : positions(*solids_[wedge]);
}

dvec3 CornerWaves::place(std::uint32_t wedge, const dvec3& towards) const {
  const auto& [first, last] = corners_of(wedge);
  const double length = edges_[wedge] ? edges_[wedge]->length : solids_[wedge]->length;
  return 0.5 * (first + last - length * towards);
}

void CornerWaves::add(std::uint32_t wedge, double share, const std::array<Visit, 2>& visits, std::span<const double> frequencies,
                      std::span<ScatteringMatrix> sum) const {
  if (edges_[wedge])
    add_both_ways(*edges_[wedge], share, visits, frequencies, sum);
  else
    add_both_ways(*solids_[wedge], share, visits, frequencies, sum);
}

}  // namespace raytube
