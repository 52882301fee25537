#include "utd/shadow/edge_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "utd/shadow/triangle_shadow.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// Lit parts end within this fraction of the wedge's length.
constexpr double clip_tolerance = 1e-13;
// The fraction of the wedge's length at about which single precision stops telling blockers apart.
constexpr double single_blocker = 1e-5;
// The outermost test points stand this far inside the ends, as a fraction of the length: at a corner the third face is touched.
constexpr double end_margin = 1e-6;
// Rays along a shadow boundary meet or miss what throws the shadow by rounding alone. They start this far outside the edge they
// are for, in radii of the target: which side of the boundary that is does not depend on rounding. As far as single precision may
// be wrong (ExactHit), or as double precision, where that decides.
constexpr double outwards_single = 4e-6, outwards_double = 1e-11;

}  // namespace

/// Tests single points of one wedge.
struct EdgeVisibility::Probe {
  const Wedge& wedge;
  const Tracer& tracer;
  Viewpoint view;
  dvec3 offset;
  dvec3 outwards;  // out of the metal, across the edge, in lengths of the target's radius
  IgnoredPatches own_patches{wedge.faces[0].patch, wedge.faces[1].patch, wedge.border_patch};

  /// Beside this point.
  dvec3 origin(double fraction, double outside) const {
    return glm::mix(wedge.start, wedge.end, fraction) + offset + outside * outwards;
  }
  Ray ray(double fraction, double outside = outwards_single) const {
    const dvec3 from = origin(fraction, outside);
    return {from, view.from(from)};
  }
  TriangleShadow shadow(std::uint32_t triangle, double outside) const {
    return {tracer.mesh(), triangle, origin(0.0, outside), origin(1.0, outside), view};
  }

  /// The nearest triangle in the way of this point, or no_index.
  std::uint32_t blocker(double fraction, double outside = outwards_single) const {
    const Ray out = ray(fraction, outside);
    return tracer.blocker(out.origin, out.direction, own_patches);
  }
  /// This triangle or one of its neighbours if in the way of this point, in double precision; or no_index.
  std::uint32_t blocker_around(double fraction, std::uint32_t triangle) const {
    const Ray out = ray(fraction, outwards_double);
    return tracer.blocker_around(out.origin, out.direction, triangle, own_patches);
  }

  double search(double lit_end, double dark_end, std::uint32_t blocker_there) const;
  double transition(double lit_end, double dark_end, std::uint32_t hidden_by) const;
};

/// Where the shadow that `blocker` throws on the dark end stops: by search while the interval is wide enough to hold other
/// blockers, then with this blocker and its neighbours alone, in double precision.
double EdgeVisibility::Probe::search(double lit_end, double dark_end, std::uint32_t blocker_there) const {
  while (std::abs(dark_end - lit_end) > clip_tolerance) {
    const double middle = (lit_end + dark_end) / 2;
    bool dark = blocker_around(middle, blocker_there) != no_index;
    if (!dark && std::abs(dark_end - lit_end) > single_blocker) {
      const std::uint32_t other = blocker(middle);
      dark = other != no_index;
      if (dark) blocker_there = other;
    }
    (dark ? dark_end : lit_end) = middle;
  }
  return (lit_end + dark_end) / 2;
}

/// Where the shadow on the dark end stops: from one triangle's shadow to the next, in 16 steps at most, until a ray beyond is
/// free. The neighbours are asked where rounding does not decide, just beyond the end of a shadow. Searched if that leads
/// nowhere. A triangle that hides the end by its corners, seen nearly edge on, may be met by no ray.
double EdgeVisibility::Probe::transition(double lit_end, double dark_end, std::uint32_t hidden_by) const {
  const double side = std::copysign(1.0, dark_end - lit_end);
  std::uint32_t blocker_there = blocker(dark_end);
  if (blocker_there == no_index) blocker_there = hidden_by;
  for (int step = 0; step < 16; ++step) {
    const TriangleShadow shade = shadow(blocker_there, outwards_double);
    const double end = shade.end_towards(lit_end, dark_end), room = side * (end - lit_end);
    if (!shade.hides(dark_end) || !(room > clip_tolerance)) break;
    double beyond = end - side * std::min(rounding_guard, room / 2);
    std::uint32_t next = blocker_around(beyond, blocker_there);
    if (next == no_index) next = blocker(beyond = end - side * std::min(single_blocker, room / 2), outwards_double);
    if (next == no_index) return end;
    dark_end = beyond, blocker_there = next;
  }
  return search(lit_end, dark_end, blocker_there);
}

namespace {

// Two test points for each wavelength, 8 to 128 of them.
int point_count(double length, double wavelength) {
  const double wanted = std::ceil(2 * length / wavelength) + 1;
  return static_cast<int>(std::clamp(wanted, 8.0, 128.0));
}

/// The edge of a thin plate lies half-way through it, where rays would start inside: it is lit where the one on the near side is.
dvec3 to_near_side(const Wedge& wedge, const dvec3& towards) {
  const double up = glm::dot(towards, wedge.faces[0].normal);
  return up == 0.0 ? dvec3(0.0) : (up > 0.0 ? -0.5 : 0.5) * wedge.thickness_vector;
}

/// Out of the metal, half-way between the faces; in the plane of a half plane.
dvec3 outwards(const Wedge& wedge) { return -glm::normalize(wedge.faces[0].into_face + wedge.faces[1].into_face); }

/// Regular test points, and one between neighbouring crossings that have none between them, in order: not half-way, where
/// symmetric bodies have the seams of their triangles.
void choose_points(int regular, std::span<const double> crossed, std::vector<double>& points) {
  points.clear();
  const auto fraction = [&](int point) { return end_margin + (1 - 2 * end_margin) * point / (regular - 1); };
  int next = 0;
  double before = 0.0;
  const auto pass = [&](double crossing) {
    const double between = std::clamp(before + (std::numbers::sqrt2 - 1) * (crossing - before), end_margin, 1 - end_margin);
    const bool none = next == regular || fraction(next) > crossing;
    if (none && crossing - before > clip_tolerance) points.push_back(between);
    for (; next < regular && fraction(next) <= crossing; ++next) points.push_back(fraction(next));
    before = crossing;
  };
  for (const double crossing : crossed) pass(crossing);
  pass(1.0);
}

/// Walks along the wedge and notes where light changes to shadow and back; transition(lit, dark) is where between two points, by
/// their index.
template <class Transition>
void scan(std::span<const std::uint32_t> hidden_by, Transition transition, std::vector<LitInterval>& lit) {
  double begin = 0.0;
  const auto is_lit = [&](std::size_t i) { return hidden_by[i] == no_index; };
  for (std::size_t i = 1; i < hidden_by.size(); ++i) {
    if (is_lit(i - 1) && !is_lit(i)) lit.push_back({begin, transition(i - 1, i)});
    if (is_lit(i) && !is_lit(i - 1)) begin = transition(i, i - 1);
  }
  if (hidden_by.back() == no_index) lit.push_back({begin, 1.0});
}

/// At a corner that another face touches single precision does not know on which side of that face the outermost test point lies:
/// what is said about it alone does not count.
void follow_neighbours_at_ends(std::vector<LitInterval>& lit) {
  constexpr double alone = 2 * end_margin;
  std::erase_if(lit, [](const LitInterval& part) { return part.end < alone || part.begin > 1 - alone; });
  for (LitInterval& part : lit) {
    if (part.begin < alone) part.begin = 0.0;
    if (part.end > 1 - alone) part.end = 1.0;
  }
}

}  // namespace

EdgeVisibility::EdgeVisibility(std::span<const Wedge> wedges, const Tracer& tracer, const Viewpoint& view, double wavelength)
    : wedges_(wedges), tracer_(tracer), view_(view), wavelength_(wavelength) {
  if (view.far()) crossings_.emplace(wedges, view.from(dvec3(0.0)));
}

void EdgeVisibility::find(std::uint32_t index, const dvec3& away, std::vector<LitInterval>& lit) {
  lit.clear();
  if (crossings_) crossings_->find(index, crossed_);
  choose_points(point_count(wedges_[index].length(), wavelength_), crossed_, points_);
  const dvec3 near_side = to_near_side(wedges_[index], away == dvec3(0.0) ? view_.from(wedges_[index].start) : away);
  // A ray in the plane of a face runs along the mesh; it starts 1e-6 radii of the target above it: the lit limit.
  const Probe probe{wedges_[index], tracer_, view_, away * (1e-6 * tracer_.mesh().radius) + near_side,
                    tracer_.mesh().radius * outwards(wedges_[index])};
  test_points(probe);
  const auto transition = [&](std::size_t lit_point, std::size_t dark_point) {
    return probe.transition(points_[lit_point], points_[dark_point], hidden_by_[dark_point]);
  };
  scan(hidden_by_, transition, lit);
  follow_neighbours_at_ends(lit);
}

// Most edges are either hidden, by few triangles, or free: one point after the other while these are hidden, then all at once. On
// a body without shadows, all at once.
void EdgeVisibility::test_points(const Probe& probe) {
  hidden_by_.assign(points_.size(), no_index);
  waiting_.resize(points_.size());
  std::iota(waiting_.begin(), waiting_.end(), 0u);
  drop_hidden(probe, last_blocker_);
  while (last_blocker_ != no_index && !waiting_.empty()) {
    const Ray middle = probe.ray(points_[waiting_[waiting_.size() / 2]]);
    std::uint32_t blocker = no_index;
    tracer_.any_blockers({&middle, 1}, probe.own_patches, {&blocker, 1});
    if (blocker == no_index) break;
    hidden_by_[waiting_[waiting_.size() / 2]] = blocker;
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_.size() / 2));
    drop_hidden(probe, last_blocker_ = blocker);
  }
  rays_.clear();
  for (const std::uint32_t point : waiting_) rays_.push_back(probe.ray(points_[point]));
  found_.resize(rays_.size());
  tracer_.any_blockers(rays_, probe.own_patches, found_);
  for (std::size_t i = 0; i < found_.size(); ++i) {
    hidden_by_[waiting_[i]] = found_[i];
    if (found_[i] != no_index) last_blocker_ = found_[i];
  }
}

void EdgeVisibility::drop_hidden(const Probe& probe, std::uint32_t blocker) {
  if (blocker == no_index ||
      std::ranges::find(probe.own_patches, tracer_.mesh().triangle_patch[blocker]) != probe.own_patches.end())
    return;
  const TriangleShadow shadow = probe.shadow(blocker, outwards_single);
  std::erase_if(waiting_, [&](std::uint32_t point) {
    if (!shadow.hides(points_[point])) return false;
    hidden_by_[point] = blocker;
    return true;
  });
}

}  // namespace raytube
