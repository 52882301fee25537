#include "utd/fan/ray_fan.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "utd/wedge/rounding_guard.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// How much farther apart rays are for every metre along them from `base`, as a vector that components are taken of.
dvec3 growth_of(const RayFan& fan) {
  const dvec3 upright = fan.direction - glm::dot(fan.direction, fan.step) / glm::dot(fan.step, fan.step) * fan.step;
  return fan.divergence / glm::dot(upright, fan.direction) * upright;
}

}  // namespace

struct RayFanTracer::FanPlane {
  dvec3 normal, across;  // for a point of the plane, the component along `across` times `scale` is its position
  double scale;
  dvec3 growth;

  explicit FanPlane(const RayFan& fan)
      : normal(glm::cross(fan.step, fan.direction)),
        across(fan.step - glm::dot(fan.step, fan.direction) * fan.direction),
        scale(1.0 / glm::dot(across, across)),
        growth(fan.divergence == 0.0 ? dvec3(0.0) : growth_of(fan)) {}
};

double facing_of(const RayFan& fan, const Patch& plane) {
  const double facing = glm::dot(plane.normal, fan.direction);
  if (fan.divergence == 0.0) return facing;
  return facing + fan.divergence * (plane.offset - glm::dot(plane.normal, fan.base));
}

RayFan reflected(const RayFan& fan, const FanHit& hit, const dvec3& normal) {
  const dvec3& d = fan.direction;
  return {fan.base + hit.length * d, fan.step + hit.growth * d, glm::reflect(d, normal), hit.from, hit.to};
}

RayFan reflected_image(const RayFan& fan, const FanHit& hit, const dvec3& normal, double offset) {
  const dvec3 base = fan.base - 2.0 * (glm::dot(normal, fan.base) - offset) * normal;
  return {base,
          glm::reflect(fan.step, normal),
          glm::reflect(fan.direction, normal),
          hit.from,
          hit.to,
          fan.divergence,
          hit.length,
          hit.growth};
}

void RayFanTracer::trace(const RayFan& fan, const IgnoredPatches& ignored_patches, std::vector<FanHit>& hits) {
  hits.clear();
  gather(fan, ignored_patches);
  work_ += work::fan + work::face_in_fan * static_cast<double>(near_.size());
  if (crossed_.empty()) return;
  cut(fan);
  work_ += work::order_in_fan * static_cast<double>(cuts_.size() * crossed_.size());
  const double least = tie_guard * tree_.mesh().radius;
  for (std::size_t i = 1; i < cuts_.size(); ++i) {
    if (cuts_[i] - cuts_[i - 1] <= least) continue;
    const double middle = (cuts_[i - 1] + cuts_[i]) / 2;
    go_on_to(middle);
    const FanHit* first = first_at(fan, middle);
    if (!first) continue;
    if (!hits.empty() && hits.back().face == first->face && cuts_[i - 1] - hits.back().to <= least)
      hits.back().to = cuts_[i];
    else
      hits.push_back({first->face, cuts_[i - 1], cuts_[i], first->length, first->growth});
  }
}

void RayFanTracer::gather(const RayFan& fan, const IgnoredPatches& ignored_patches) {
  crossed_.clear();
  const TriangleMesh& mesh = tree_.mesh();
  near_.clear();
  // With so few faces it costs less to try all than to ask the tree.
  if (tree_.faces().size() <= 24) {
    for (std::uint32_t face = 0; face < tree_.faces().size(); ++face) near_.push_back(face);
  } else {
    collect_near(fan);
  }
  const FanPlane plane(fan);
  for (const std::uint32_t face : near_) {
    const Face& polygon = tree_.faces()[face];
    if (std::ranges::find(ignored_patches, polygon.patch) != ignored_patches.end()) continue;
    const double facing = facing_of(fan, mesh.patches[polygon.patch]);
    if (std::abs(facing) < rounding_guard || (facing > 0.0 && mesh.closed(polygon.triangle))) continue;
    intersect(fan, plane, face, facing);
  }
}

void RayFanTracer::collect_near(const RayFan& fan) {
  const dvec3 u = glm::normalize(fan.step - glm::dot(fan.step, fan.direction) * fan.direction);
  const dvec3 v = glm::cross(fan.direction, u);
  const double rate = glm::dot(fan.step, u);
  double from = fan.from, to = fan.to;
  if (fan.divergence != 0.0) {
    const double farthest = glm::length(fan.base) + tree_.mesh().radius;
    const double wider = std::max(0.0, 1.0 + fan.divergence * farthest);
    from = std::min(from, from * wider);
    to = std::max(to, to * wider);
  }
  tree_.collect({fan.base, u, v, fan.direction, {rate * from, 0.0}, {rate * to, 0.0}}, near_);
}

// Where the fan's plane cuts a convex polygon: a segment, in positions and distances.
void RayFanTracer::intersect(const RayFan& fan, const FanPlane& in, std::uint32_t face, double facing) {
  const TriangleMesh& mesh = tree_.mesh();
  const std::span<const std::uint32_t> corners = tree_.corners(face);
  double from = std::numeric_limits<double>::infinity(), to = -from;
  dvec3 before = mesh.vertices[corners.back()] - fan.base;
  double height_before = glm::dot(in.normal, before);
  for (const std::uint32_t corner : corners) {
    const dvec3 here = mesh.vertices[corner] - fan.base;
    const double height = glm::dot(in.normal, here);
    if ((height >= 0.0) != (height_before >= 0.0)) {
      const dvec3 point = before + height_before / (height_before - height) * (here - before);
      double position = in.scale * glm::dot(in.across, point);
      // Nothing counts that is within a thousandth of the way to the point the rays come from.
      if (fan.divergence != 0.0) position /= std::max(1e-3, 1.0 + glm::dot(in.growth, point));
      from = std::min(from, position);
      to = std::max(to, position);
    }
    before = here;
    height_before = height;
  }
  from = std::max(from, fan.from);
  to = std::min(to, fan.to);
  if (!(from < to)) return;
  const Patch& plane = mesh.patches[tree_.faces()[face].patch];
  const FanHit hit{face, from, to, (plane.offset - glm::dot(plane.normal, fan.base)) / facing,
                   -glm::dot(plane.normal, fan.step) / facing};
  // Rays that begin all along in the plane of a face, within rounding, do not meet it, as hits at no distance do not count: there
  // bodies touch, and rounding parts their faces by three steps of coordinates at most.
  const auto above = [&](double z) { return std::abs((hit.length - fan.begin + (hit.growth - fan.growth) * z) * facing); };
  const double rounding = 3.0 * mesh.coordinate_step;
  if (above(from) <= rounding && above(to) <= rounding && rounding > 0.0) return;
  crossed_.push_back(hit);
}

// Between neighbouring cuts the order of the faces is the same, and all lie on one side of the start.
void RayFanTracer::cut(const RayFan& fan) {
  cuts_.clear();
  for (const FanHit& face : crossed_) {
    cuts_.insert(cuts_.end(), {face.from, face.to});
    const double start = -(face.length - fan.begin) / (face.growth - fan.growth);
    if (start > face.from && start < face.to) cuts_.push_back(start);
  }
  std::ranges::sort(cuts_);
  covering_.clear();
  coming_.clear();
  for (const FanHit& face : crossed_) coming_.push_back(&face);
  std::ranges::sort(coming_, std::ranges::greater(), [](const FanHit* face) { return std::pair(face->from, face); });
}

void RayFanTracer::go_on_to(double position) {
  for (; !coming_.empty() && coming_.back()->from <= position; coming_.pop_back()) covering_.push_back(coming_.back());
  std::erase_if(covering_, [&](const FanHit* face) { return face->to < position; });
}

const FanHit* RayFanTracer::first_at(const RayFan& fan, double position) const {
  const FanHit* first = nullptr;
  double nearest = fan.divergence > 0.0 ? 1.0 / fan.divergence : std::numeric_limits<double>::infinity();
  const double start = fan.begin + fan.growth * position + tie_guard * tree_.mesh().radius;
  for (const FanHit* face : covering_) {
    const double distance = face->length + face->growth * position;
    if (distance <= start || distance > nearest || (distance == nearest && face > first)) continue;
    first = face;
    nearest = distance;
  }
  return first;
}

}  // namespace raytube
