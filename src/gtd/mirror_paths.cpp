#include "gtd/mirror_paths.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raytube {

namespace {

// Above a mirror, in units of the distance: closer to grazing physical optics has no light either.
constexpr double least_height = 1e-7;

// Over a right-angled corner the path there and back runs through the corner itself, whichever face comes first, and all orders
// of the faces are one wave. Paths of several mirrors are therefore searched to a point this far beside their end, in units of
// the target's radius: one order is found. Their length is that to the end itself.
const dvec3 beside(5.4e-8, 7.2e-8, 4.4e-8);

double height(const Patch& plane, const dvec3& point) { return glm::dot(plane.normal, point) - plane.offset; }

dvec3 mirrored(const Patch& plane, const dvec3& point) { return point - 2.0 * height(plane, point) * plane.normal; }

}  // namespace

// One look's search, level by level.
class MirrorPaths::Search {
 public:
  Search(const MirrorPaths& scene, const dvec3& from, const dvec3& to, std::span<const std::uint32_t> boundary_patches)
      : scene_(scene), mesh_(scene.surfaces_.mesh()), from_(from), to_(to), boundary_patches_(boundary_patches) {}

  MirrorPathList run(int most) {
    std::size_t begin = 0, end = 0;
    grow({from_, no_index, -1}, -1);
    for (int level = 1; level < most && !found_.cut; ++level) {
      begin = std::exchange(end, stages_.size());
      for (std::size_t i = begin; i < end && !found_.cut; ++i) grow(stages_[i], static_cast<std::ptrdiff_t>(i));
    }
    return std::move(found_);
  }

 private:
  // All sequences with one mirror more. `last` is a copy: stages move as they become more.
  void grow(const Stage last, std::ptrdiff_t index) {
    for (std::uint32_t patch = 0; patch < mesh_.patches.size(); ++patch) {
      if (++tests_ > most_tests) found_.cut = true;
      if (found_.cut) return;
      const Patch& plane = mesh_.patches[patch];
      if (patch == last.patch || !lights(last.image, patch) || !in_beam(last, patch)) continue;
      stages_.push_back({mirrored(plane, last.image), patch, index});
      try_path(stages_.back());
    }
  }

  bool lights(const dvec3& source, std::uint32_t patch) const {
    const double above = height(mesh_.patches[patch], source), least = least_height * glm::length(source);
    return above > least || (scene_.balls_[patch].two_sided && above < -least);
  }

  // Conservative: what the ball around the last mirror reflects, spreading as it does from the image of the source.
  bool in_beam(const Stage& last, std::uint32_t patch) const {
    if (last.patch == no_index) return true;
    const Ball &from = scene_.balls_[last.patch], &to = scene_.balls_[patch];
    const dvec3 axis = from.middle - last.image, way = to.middle - from.middle;
    const double distance = glm::length(axis), along = glm::dot(way, axis) / distance, reach = from.radius + to.radius;
    if (along < -reach) return false;
    const double wide = reach + from.radius * std::max(along, 0.0) / std::max(distance - from.radius, 1e-3 * distance);
    if (glm::dot(way, way) - along * along > wide * wide) return false;
    const Patch& mirror = mesh_.patches[last.patch];
    const double side = height(mirror, last.image) < 0.0 ? 1.0 : -1.0;  // the image lies behind the mirror
    return side * height(mirror, to.middle) > -to.radius;
  }

  void try_path(const Stage& last) {
    reflections_.clear();
    patches_.clear();
    sheets_.clear();
    const bool single = last.before < 0,
               forced = single && std::ranges::find(boundary_patches_, last.patch) != boundary_patches_.end();
    const dvec3 goal = single ? to_ : to_ + mesh_.radius * beside;
    dvec3 point = goal;
    for (const Stage* stage = &last; stage; stage = stage->before < 0 ? nullptr : &stages_[stage->before]) {
      const Patch& plane = mesh_.patches[stage->patch];
      const double above = height(plane, point), below = height(plane, stage->image);
      if (!(above * below < 0.0)) return;
      point += above / (above - below) * (stage->image - point);
      const Ball& ball = scene_.balls_[stage->patch];
      if (!forced && glm::length(point - ball.middle) > ball.radius * (1 + 1e-9)) return;
      reflections_.push_back(point);
      patches_.push_back(stage->patch);
    }
    std::ranges::reverse(reflections_);
    std::ranges::reverse(patches_);
    if (forced)
      sheets_.resize(2);
    else if (!clear(goal))
      return;
    found_.paths.push_back({patches_, sheets_, glm::length(to_ - last.image)});
  }

  // Every leg ends on the patch it is meant for: from outside the target to the first, from one to the next, and out again.
  bool clear(const dvec3& goal) {
    const dvec3 arriving = glm::normalize(reflections_.front() - from_);
    if (!meets({reflections_.front() - 4.0 * mesh_.radius * arriving, arriving, no_index}, patches_.front())) return false;
    for (std::size_t i = 0; i + 1 < reflections_.size(); ++i)
      if (!meets({reflections_[i], glm::normalize(reflections_[i + 1] - reflections_[i]), patches_[i]}, patches_[i + 1]))
        return false;
    return keep(scene_.surfaces_.outwards(reflections_.back(), goal, {patches_.back(), no_index, no_index}));
  }

  bool meets(const Ray& ray, std::uint32_t patch) { return keep(scene_.surfaces_.to_patch(ray, patch)); }

  bool keep(std::optional<SheetsPassed> sheets) {
    ++found_.rays;
    if (sheets) sheets_.push_back(std::move(*sheets));
    return sheets.has_value();
  }

  const MirrorPaths& scene_;
  const TriangleMesh& mesh_;
  dvec3 from_, to_;
  std::span<const std::uint32_t> boundary_patches_;
  std::vector<Stage> stages_;
  std::vector<dvec3> reflections_;
  std::vector<std::uint32_t> patches_;
  std::vector<SheetsPassed> sheets_;
  MirrorPathList found_;
  std::uint64_t tests_ = 0;
};

MirrorPaths::MirrorPaths(const RaySurfaces& surfaces) : surfaces_(surfaces), balls_(surfaces.mesh().patches.size()) {
  const TriangleMesh& mesh = surfaces.mesh();
  std::vector<std::array<dvec3, 2>> boxes(balls_.size(), {dvec3(INFINITY), dvec3(-INFINITY)});
  const auto for_corners = [&](auto visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) visit(t, mesh.triangle_patch[t], mesh.vertices[v]);
  };
  for_corners([&](std::uint32_t triangle, std::uint32_t patch, const dvec3& corner) {
    boxes[patch] = {glm::min(boxes[patch][0], corner), glm::max(boxes[patch][1], corner)};
    balls_[patch].middle = 0.5 * (boxes[patch][0] + boxes[patch][1]);
    balls_[patch].two_sided = !mesh.closed(triangle);
  });
  for_corners([&](std::uint32_t, std::uint32_t patch, const dvec3& corner) {
    balls_[patch].radius = std::max(balls_[patch].radius, glm::length(corner - balls_[patch].middle));
  });
}

MirrorPathList MirrorPaths::find(const dvec3& from, const dvec3& to, int most,
                                 std::span<const std::uint32_t> boundary_patches) const {
  return Search(*this, from, to, boundary_patches).run(most);
}

}  // namespace raytube
