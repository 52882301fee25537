#include "utd/interaction/ray_fan.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/work.h"

namespace raytube {

namespace {

// With so few faces it costs less to try all than to ask the tree.
constexpr std::size_t few_faces = 24;
constexpr double parallel = 1e-9;        // sine between rays and a plane below which they never meet
constexpr double same_position = 1e-12;  // in radii of the target

}  // namespace

RayFan reflected(const RayFan& fan, const FanHit& hit, const dvec3& normal) {
  const dvec3& d = fan.direction;
  return {fan.base + hit.length * d, fan.step + hit.growth * d, glm::reflect(d, normal), hit.from, hit.to};
}

void RayFanTracer::trace(const RayFan& fan, const IgnoredPatches& ignored_patches, std::vector<FanHit>& hits) {
  hits.clear();
  gather(fan, ignored_patches);
  work_ += work::fan + work::face_in_fan * static_cast<double>(near_.size());
  if (crossed_.empty()) return;
  cut();
  work_ += work::order_in_fan * static_cast<double>(cuts_.size() * crossed_.size());
  const double least = same_position * tree_.mesh().radius;
  for (std::size_t i = 1; i < cuts_.size(); ++i) {
    if (cuts_[i] - cuts_[i - 1] <= least) continue;
    const double middle = (cuts_[i - 1] + cuts_[i]) / 2;
    go_on_to(middle);
    const FanHit* first = first_at(middle);
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
  if (tree_.faces().size() <= few_faces) {
    for (std::uint32_t face = 0; face < tree_.faces().size(); ++face) near_.push_back(face);
  } else {
    const dvec3 u = glm::normalize(fan.step - glm::dot(fan.step, fan.direction) * fan.direction);
    const dvec3 v = glm::cross(fan.direction, u);
    const double rate = glm::dot(fan.step, u);
    tree_.collect({fan.base, u, v, fan.direction, {rate * fan.from, 0.0}, {rate * fan.to, 0.0}}, near_);
  }
  for (const std::uint32_t face : near_) {
    const Face& polygon = tree_.faces()[face];
    if (std::ranges::find(ignored_patches, polygon.patch) != ignored_patches.end()) continue;
    const double facing = glm::dot(mesh.patches[polygon.patch].normal, fan.direction);
    if (std::abs(facing) < parallel || (facing > 0.0 && mesh.closed(polygon.triangle))) continue;
    intersect(fan, face);
  }
}

// Where the fan's plane cuts a convex polygon: a segment, in positions and distances.
void RayFanTracer::intersect(const RayFan& fan, std::uint32_t face) {
  const TriangleMesh& mesh = tree_.mesh();
  const std::span<const std::uint32_t> corners = tree_.corners(face);
  const dvec3 normal = glm::cross(fan.step, fan.direction);
  const dvec3 across = fan.step - glm::dot(fan.step, fan.direction) * fan.direction;
  const double scale = 1.0 / glm::dot(across, across);
  double from = std::numeric_limits<double>::infinity(), to = -from;
  dvec3 before = mesh.vertices[corners.back()] - fan.base;
  double height_before = glm::dot(normal, before);
  for (const std::uint32_t corner : corners) {
    const dvec3 here = mesh.vertices[corner] - fan.base;
    const double height = glm::dot(normal, here);
    if ((height >= 0.0) != (height_before >= 0.0)) {
      const dvec3 point = before + height_before / (height_before - height) * (here - before);
      const double position = scale * glm::dot(across, point);
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
  const double facing = glm::dot(plane.normal, fan.direction);
  crossed_.push_back(
      {face, from, to, (plane.offset - glm::dot(plane.normal, fan.base)) / facing, -glm::dot(plane.normal, fan.step) / facing});
}

// Between neighbouring cuts the order of the faces is the same, and all lie on one side of the start.
void RayFanTracer::cut() {
  cuts_.clear();
  for (const FanHit& face : crossed_) {
    cuts_.insert(cuts_.end(), {face.from, face.to});
    const double start = -face.length / face.growth;
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

const FanHit* RayFanTracer::first_at(double position) const {
  const FanHit* first = nullptr;
  double nearest = std::numeric_limits<double>::infinity();
  const double start = same_position * tree_.mesh().radius;
  for (const FanHit* face : covering_) {
    const double distance = face->length + face->growth * position;
    if (distance <= start || distance > nearest || (distance == nearest && face > first)) continue;
    first = face;
    nearest = distance;
  }
  return first;
}

}  // namespace raytube
