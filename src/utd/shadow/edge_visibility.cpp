#include "utd/shadow/edge_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace raytube {

namespace {

constexpr int min_points = 8;
constexpr int max_points = 128;
constexpr double clip_tolerance = 1e-13;  // fraction of the wedge's length
constexpr double single_blocker = 1e-5;   // fraction of it; about where single precision stops telling blockers apart
// Test points between crossings: not half-way, where symmetric bodies have the seams of their triangles.
constexpr double beside_middle = std::numbers::sqrt2 - 1;
// The outermost test points stand this far inside the ends, as a fraction of the length: at a corner the third face is touched.
constexpr double end_margin = 1e-6;
// A ray in the plane of a face runs along the mesh; it starts this far above it, in radii of the target: the lit limit.
constexpr double lift = 1e-6;
// Rays along a shadow boundary meet or miss what throws the shadow by rounding alone. They start this far outside the edge they
// are for, in radii of the target: which side of the boundary that is does not depend on rounding. As far as single precision may
// be wrong (ExactHit), or as double precision, where that decides.
constexpr double outwards_single = 4e-6, outwards_double = 1e-11;
// Moves a shadow boundary along the edge by less than this, as a fraction of the edge's length.
constexpr double beside_crossing = 1e-9;

/// Tests single points of one wedge.
struct EdgeProbe {
  const Wedge& wedge;
  const Tracer& tracer;
  Viewpoint view;
  dvec3 offset;
  dvec3 outwards;  // out of the metal, across the edge, in lengths of the target's radius
  std::span<const double> crossed;
  IgnoredPatches own_patches{wedge.faces[0].patch, wedge.faces[1].patch, wedge.border_patch};

  dvec3 point(double fraction) const { return glm::mix(wedge.start, wedge.end, fraction) + offset; }

  /// From beside this point.
  Ray ray(double fraction, double outside = outwards_single) const {
    const dvec3 origin = point(fraction) + outside * outwards;
    return {origin, view.from(origin)};
  }

  /// A triangle in the way of this point, or no_index.
  std::uint32_t blocker(double fraction) const {
    const Ray out = ray(fraction);
    return tracer.blocker(out.origin, out.direction, own_patches);
  }
  /// Whether this triangle or one of its neighbours is in the way of this point, in double precision.
  bool meets(double fraction, std::uint32_t triangle) const {
    const Ray out = ray(fraction, outwards_double);
    return tracer.meets_around(out.origin, out.direction, triangle, own_patches);
  }

  /// Whether a shadow on the dark end's side stops at `fraction`: at single_blocker from it, or half-way to the ends where these
  /// are nearer, rays tell; at beside_crossing the double-precision decision about the blocker they found.
  bool is_transition(double fraction, double lit_end, double dark_end) const {
    const double side = std::copysign(1.0, dark_end - lit_end);
    const double to_lit = std::min(single_blocker, std::abs(fraction - lit_end) / 2);
    const double to_dark = std::min(single_blocker, std::abs(fraction - dark_end) / 2);
    if (std::min(to_lit, to_dark) <= clip_tolerance || blocker(fraction - side * to_lit) != no_index) return false;
    const std::uint32_t other = blocker(fraction + side * to_dark);
    const auto is_dark = [&](double at) { return meets(at, other); };
    const double beside = std::min({beside_crossing, to_lit, to_dark});
    return other != no_index && is_dark(fraction + side * beside) && !is_dark(fraction - side * beside);
  }

  /// Where the shadow that `blocker` throws on the dark end stops: by search while the interval is wide enough to hold other
  /// blockers, then with this blocker and its neighbours alone, in double precision.
  double search(double lit_end, double dark_end, std::uint32_t blocker_there) const {
    while (std::abs(dark_end - lit_end) > clip_tolerance) {
      const double middle = (lit_end + dark_end) / 2;
      bool dark = meets(middle, blocker_there);
      if (!dark && std::abs(dark_end - lit_end) > single_blocker) {
        const std::uint32_t other = blocker(middle);
        dark = other != no_index;
        if (dark) blocker_there = other;
      }
      (dark ? dark_end : lit_end) = middle;
    }
    return (lit_end + dark_end) / 2;
  }

  /// Where that shadow stops. On a polygonal body it is one of the crossings, which need only be confirmed; else it is searched.
  double transition(double lit_end, double dark_end, std::uint32_t blocker_there) const {
    const auto [low, high] = std::minmax(lit_end, dark_end);
    for (auto crossing = std::ranges::lower_bound(crossed, low); crossing != crossed.end() && *crossing < high; ++crossing)
      if (is_transition(*crossing, lit_end, dark_end)) return *crossing;
    return search(lit_end, dark_end, blocker_there);
  }
};

int point_count(double length, double wavelength) {
  const double wanted = std::ceil(2 * length / wavelength) + 1;
  return static_cast<int>(std::clamp(wanted, double{min_points}, double{max_points}));
}

/// The edge of a thin plate lies half-way through it, where rays would start inside: it is lit where the one on the near side is.
dvec3 to_near_side(const Wedge& wedge, const dvec3& towards) {
  const double up = glm::dot(towards, wedge.faces[0].normal);
  return up == 0.0 ? dvec3(0.0) : (up > 0.0 ? -0.5 : 0.5) * wedge.thickness_vector;
}

/// Out of the metal, half-way between the faces; in the plane of a half plane.
dvec3 outwards(const Wedge& wedge) { return -glm::normalize(wedge.faces[0].into_face + wedge.faces[1].into_face); }

/// Regular test points, and one between neighbouring crossings that have none between them, in order.
void choose_points(int regular, std::span<const double> crossed, std::vector<double>& points) {
  points.clear();
  const auto fraction = [&](int point) { return end_margin + (1 - 2 * end_margin) * point / (regular - 1); };
  int next = 0;
  double before = 0.0;
  const auto pass = [&](double crossing) {
    const double between = std::clamp(before + beside_middle * (crossing - before), end_margin, 1 - end_margin);
    const bool none = next == regular || fraction(next) > crossing;
    if (none && crossing - before > clip_tolerance) points.push_back(between);
    for (; next < regular && fraction(next) <= crossing; ++next) points.push_back(fraction(next));
    before = crossing;
  };
  for (const double crossing : crossed) pass(crossing);
  pass(1.0);
}

/// Walks along the wedge and notes where light changes to shadow and back.
void scan(const EdgeProbe& probe, std::span<const double> points, std::span<const std::uint32_t> blockers,
          std::vector<LitInterval>& lit) {
  double begin = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const bool was_lit = blockers[i - 1] == no_index, is_lit = blockers[i] == no_index;
    if (was_lit && !is_lit) lit.push_back({begin, probe.transition(points[i - 1], points[i], blockers[i])});
    if (is_lit && !was_lit) begin = probe.transition(points[i], points[i - 1], blockers[i - 1]);
  }
  if (blockers.back() == no_index) lit.push_back({begin, 1.0});
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
  const EdgeProbe probe{wedges_[index],
                        tracer_,
                        view_,
                        away * (lift * tracer_.mesh().radius) + near_side,
                        tracer_.mesh().radius * outwards(wedges_[index]),
                        crossed_};
  rays_.clear();
  for (const double point : points_) rays_.push_back(probe.ray(point));
  blockers_.resize(points_.size());
  tracer_.blockers(rays_, probe.own_patches, blockers_);
  scan(probe, points_, blockers_, lit);
  follow_neighbours_at_ends(lit);
}

}  // namespace raytube
