#include "utd/interaction/pair_plan.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <ranges>

namespace raytube {

namespace {

// Pairs whose strengths differ by less than this share are equal: those of a body that is turned, or whose triangles come in
// another order, differ by rounding, and by that of files of few digits.
constexpr double equal_share = 2 * rounding_of_files;

// Share of all pairs of which a budget that pays for less pays for none: to list millions of pairs takes seconds, and no body
// that was tried has half of what is expected in so few.
constexpr double least_part = 1e-3;

struct Pair {
  double expected;
  std::uint32_t axis, patch;
};

// How many of the strongest count if `wanted` are paid for; `pairs` holds twice as many and one more, strongest first.
std::size_t with_equals(std::span<const Pair> pairs, double wanted) {
  if (wanted < 1.0) return 0;
  if (wanted >= static_cast<double>(pairs.size())) return pairs.size();
  const auto equal = [](const Pair& a, const Pair& b) { return a.expected - b.expected <= equal_share * a.expected; };
  std::size_t begin = static_cast<std::size_t>(wanted) - 1, end = begin + 1;
  while (begin > 0 && equal(pairs[begin - 1], pairs[begin])) --begin;
  while (end < pairs.size() && equal(pairs[end - 1], pairs[end])) ++end;
  return static_cast<double>(end) <= 2.0 * wanted ? end : begin;
}

// Solid angle of a face at a point [steradians]: that of its area far away, and of a half space close in front of it.
double solid_angle(const dvec3& point, const Patch& plane, const PatchExtent& face) {
  const dvec3 way = point - face.centroid;
  const double square = glm::dot(way, way), height = glm::dot(plane.normal, point) - plane.offset;
  if (square == 0.0) return 0.0;
  const double facing = (face.closed ? std::max(height, 0.0) : std::abs(height)) / std::sqrt(square);
  return face.area * facing / (square + face.area / (2 * pi));
}

/// The corners of a patch's triangles.
auto corners_of(const TriangleMesh& mesh, std::uint32_t patch) {
  return mesh.of_patch()[patch] | std::views::transform([&mesh](std::uint32_t t) { return mesh.corners(t); }) | std::views::join;
}

bool in_front_of(const Wedge& wedge, const TriangleMesh& mesh, std::uint32_t patch, double area) {
  const double least = rounding_of_files * std::sqrt(area);
  return wedge.n == 2.0 || std::ranges::any_of(corners_of(mesh, patch), [&](const dvec3& corner) {
           return std::ranges::any_of(wedge.faces,
                                      [&](const WedgeFace& own) { return glm::dot(own.normal, corner - wedge.start) > least; });
         });
}

}  // namespace

std::vector<PatchExtent> patch_extents(const TriangleMesh& mesh) {
  std::vector<PatchExtent> extents(mesh.patches.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    PatchExtent& extent = extents[mesh.triangle_patch[t]];
    const double area = mesh.twice_area(t) / 2;
    extent.area += area;
    extent.closed = mesh.closed(t);
    for (const std::uint32_t vertex : mesh.triangles[t]) extent.centroid += area / 3.0 * mesh.vertices[vertex];
  }
  for (PatchExtent& extent : extents) extent.centroid /= extent.area;
  return extents;
}

// An edge of length L scatters the power of a strip of about lambda / 2 pi times L (Keller 1957), of which the face takes in its
// share of the sphere and scatters it all round: |S|^2 = lambda L / 2 pi * Omega / 4 pi / 4 pi. Omega is the mean along the edge
// by Simpson's rule: whatever of the edge is in front of the face, one of its ends is.
double expected_of_pair(const EdgeAxis& axis, const TriangleMesh& mesh, std::uint32_t patch, const PatchExtent& face) {
  const Patch& plane = mesh.patches[patch];
  const auto seen_at = [&](double share) { return solid_angle(axis.origin + share * axis.length * axis.tangent, plane, face); };
  const double angle = (seen_at(0.0) + 4.0 * seen_at(0.5) + seen_at(1.0)) / 6.0;
  if (angle == 0.0 || !in_front_of(*axis.wedge, mesh, patch, face.area)) return 0.0;
  return axis.length * angle / (32 * pi * pi * pi);
}

// Set by eye between boxes and vehicles (docs/theory/interaction.md): every ray may meet any of the faces, and quadrature halves
// its panels wherever one of these begins or ends. Reflected light and rims are counted in.
double work_of_pair(std::size_t patches) { return 2.5e6 + 1.25e5 * static_cast<double>(patches); }

double bytes_of_pairs(double pairs, double work) { return std::min(pairs, 4.0 * work / work_of_pair(0)) * sizeof(Pair); }

PairPlan::PairPlan(const PairCandidates& of, double work) : all_(false), patches_(of.axes.size()), expected_(of.axes.size()) {
  const double wanted = std::floor(work / work_of_pair(of.patches.size()));
  const auto all = static_cast<double>(of.axes.size()) * static_cast<double>(of.patches.size());
  if (wanted < least_part * all) {
    left_out_ = static_cast<std::uint64_t>(all);
    for (const EdgeAxis& axis : of.axes)
      if (axis.length >= of.shortest_axis) left_ += axis.length / (16 * pi * pi);  // as if faces filled a half space about it
    return;
  }
  const auto kept = static_cast<std::size_t>(std::min(2.0 * wanted + 1.0, all));
  std::vector<Pair> pairs;
  double squares = 0.0;
  std::uint64_t seen = 0;
  const auto keep_strongest = [&] {
    if (pairs.size() <= kept) return;
    std::ranges::nth_element(pairs, pairs.begin() + static_cast<std::ptrdiff_t>(kept), std::greater{}, &Pair::expected);
    pairs.resize(kept);
  };
  for (std::uint32_t a = 0; a < of.axes.size(); ++a) {
    const EdgeAxis& axis = of.axes[a];
    if (axis.length < of.shortest_axis) continue;
    for (const std::uint32_t patch : of.patches) {
      if (patch == axis.wedge->faces[0].patch || patch == axis.wedge->faces[1].patch) continue;
      const double expected = expected_of_pair(axis, of.mesh, patch, of.extents[patch]);
      if (expected == 0.0) continue;
      ++seen, squares += expected;
      pairs.push_back({expected, a, patch});
      if (pairs.size() >= 2 * kept + of.patches.size()) keep_strongest();
    }
  }
  keep_strongest();
  std::ranges::sort(pairs, std::greater{}, &Pair::expected);
  pairs.resize(with_equals(pairs, wanted));
  for (const Pair& pair : pairs) {
    patches_[pair.axis].push_back(pair.patch);
    expected_[pair.axis] += pair.expected;
    chosen_ += pair.expected;
  }
  for (std::vector<std::uint32_t>& of_axis : patches_) std::ranges::sort(of_axis);
  pairs_ = pairs.size(), left_out_ = seen - pairs_;
  all_ = left_out_ == 0;
  left_ = std::max(squares - chosen_, 0.0);
}

bool PairPlan::has(std::size_t axis, std::uint32_t patch) const {
  return all_ || std::ranges::binary_search(patches_[axis], patch);
}

std::span<const std::uint32_t> PairPlan::patches(std::size_t axis) const {
  return all_ ? std::span<const std::uint32_t>{} : patches_[axis];
}

// Seen from the edge's line a face covers less than half a turn, or the line runs through it; azimuths are the same after a whole
// turn, of which the wedge leaves n pi free.
AzimuthRange azimuths_of(const EdgeAxis& axis, const TriangleMesh& mesh, std::uint32_t patch, const PatchExtent& face) {
  const WedgeFace& first = axis.wedge->faces[0];
  const auto across = [&](const dvec3& point) {
    return dvec2(glm::dot(point - axis.origin, first.into_face), glm::dot(point - axis.origin, first.normal));
  };
  const dvec2 middle = across(face.centroid);
  double low = 0.0, high = 0.0;
  for (const dvec3& corner : corners_of(mesh, patch)) {
    const dvec2 at = across(corner);
    const double turn = std::atan2(middle.x * at.y - middle.y * at.x, glm::dot(middle, at));
    low = std::min(low, turn), high = std::max(high, turn);
  }
  const double end = axis.wedge->n * pi, azimuth = std::atan2(middle.y, middle.x);
  if (high - low >= pi - rounding_of_files) return {0.0, end};
  AzimuthRange range{end, 0.0};
  for (const double turn : {-2 * pi, 0.0, 2 * pi}) {
    const double from = std::max(azimuth + low - rounding_of_files + turn, 0.0),
                 to = std::min(azimuth + high + rounding_of_files + turn, end);
    if (from < to) range = {std::min(range.from, from), std::max(range.to, to)};
  }
  return range;
}

}  // namespace raytube
