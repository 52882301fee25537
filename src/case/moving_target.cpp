#include "case/moving_target.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "case/target.h"
#include "case/text/keys.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/text.h"
#include "mesh/model/triangle_pairs.h"
#include "mesh/model/triangle_tree.h"

namespace raytube {

namespace {

std::size_t index_of_rest(const Motion& motion) {
  const auto rest = std::ranges::find_if(motion.bodies, [](const BodyMotion& body) { return body.parts.empty(); });
  return rest == motion.bodies.end() ? no_body : static_cast<std::size_t>(rest - motion.bodies.begin());
}

// Of each polygon, by the names that it goes by.
std::vector<std::size_t> bodies_of(const PolygonSoup& soup, const MotionChoice& choice) {
  const std::vector<std::string>& names = soup.names.all();
  std::vector<std::size_t> body_of_name(names.size(), no_body);
  for (std::size_t b = 0; b < choice.motion.bodies.size(); ++b)
    for (const std::string& part : choice.motion.bodies[b].parts) {
      const auto found = std::ranges::find(names, part);
      if (found == names.end())
        throw InputError(fmt::format("{}: motion.bodies.{}.parts: \"{}\" is not a name in the mesh; {}", choice.location,
                                     quotable(choice.motion.bodies[b].name), quotable(part), name_meant(part, names)));
      body_of_name[static_cast<std::size_t>(found - names.begin())] = b;
    }
  std::vector<std::size_t> bodies(soup.polygons.size(), index_of_rest(choice.motion));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    std::size_t own = no_body;
    for (const std::uint32_t name : soup.names.of(i)) {
      const std::size_t body = body_of_name[name];
      if (body == no_body) continue;
      if (own != no_body && own != body)
        throw InputError(
            fmt::format("{}: facet {} of the mesh goes by names of motion.bodies.{} and of motion.bodies.{}; remove "
                        "one of these names from their parts",
                        choice.location, i, quotable(choice.motion.bodies[own].name), quotable(choice.motion.bodies[body].name)));
      own = body;
    }
    if (own != no_body) bodies[i] = own;
  }
  return bodies;
}

// What two bodies share they have each for itself. Returns the body of each point.
std::vector<std::size_t> part_points(PolygonSoup& soup, const std::vector<std::size_t>& body_of_polygon) {
  constexpr std::size_t nobody_yet = no_body - 1;
  std::vector<std::size_t> body_of_point(soup.points.size(), nobody_yet);
  std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> twins;
  for (std::size_t i = 0; i < soup.polygons.size(); ++i)
    for (std::uint32_t& corner : soup.polygons[i]) {
      const std::size_t body = body_of_polygon[i];
      if (body_of_point[corner] == nobody_yet) body_of_point[corner] = body;
      if (body_of_point[corner] == body) continue;
      const auto [twin, is_new] = twins.try_emplace({corner, body}, static_cast<std::uint32_t>(soup.points.size()));
      if (is_new) {
        soup.points.push_back(dvec3(soup.points[corner]));
        body_of_point.push_back(body);
      }
      corner = twin->second;
    }
  std::ranges::replace(body_of_point, nobody_yet, no_body);
  return body_of_point;
}

// The polygons of one body alone.
PolygonSoup part_of(const PolygonSoup& soup, const std::vector<std::size_t>& body_of_polygon, std::size_t body) {
  PolygonSoup part;
  part.points = soup.points;
  for (std::size_t i = 0; i < soup.polygons.size(); ++i)
    if (body_of_polygon[i] == body) part.polygons.push_back(soup.polygons[i]);
  return part;
}

std::string name_of(const Motion& motion, std::size_t body) {
  return body == no_body ? "what stands" : fmt::format("motion.bodies.{}", quotable(motion.bodies[body].name));
}

}  // namespace

MovingTarget::MovingTarget(PolygonSoup soup, const Case& c) : case_(c), soup_(std::move(soup)) {
  case_.sweep.looks.clear(), case_.sweep.times.clear();
  body_of_polygon_ = bodies_of(soup_, *c.motion);
  std::set<std::size_t> movers;
  for (const std::size_t body : body_of_polygon_) movers.insert(carried_by(motion(), body));
  as_one_ = movers.size() == 1;
  if (as_one_)
    mover_ = *movers.begin();
  else
    body_of_point_ = part_points(soup_, body_of_polygon_);
}

std::vector<MovingTarget::RigidPart> MovingTarget::rigid_parts() const {
  std::map<std::size_t, Box> boxes;
  for (std::size_t i = 0; i < soup_.polygons.size(); ++i)
    for (const std::uint32_t corner : soup_.polygons[i])
      boxes[carried_by(motion(), body_of_polygon_[i])].add(soup_.points[corner] * case_.metres_per_unit);
  std::vector<RigidPart> parts;
  for (const auto& [mover, box] : boxes) parts.push_back({mover, box});
  return parts;
}

LoadedMesh MovingTarget::at_rest() const { return build_target(soup_, case_, mesh_names(case_)); }

std::vector<dvec3> MovingTarget::corners(double time) const {
  const std::vector<dvec3> points = points_at(time);
  std::vector<char> is_corner(points.size());
  for (const auto& polygon : soup_.polygons)
    for (const std::uint32_t corner : polygon) is_corner[corner] = 1;
  std::vector<dvec3> corners;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_corner[i]) corners.push_back(points[i] * case_.metres_per_unit);
  return corners;
}

std::vector<dvec3> MovingTarget::points_at(double time) const {
  std::map<std::size_t, Pose> poses;
  for (std::size_t body = 0; body < motion().bodies.size(); ++body) poses.emplace(body, pose_of(motion(), body, time));
  std::vector<dvec3> points = soup_.points;
  const double unit = case_.metres_per_unit;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t body = as_one_ ? mover_ : body_of_point_[i];
    if (body == no_body) continue;
    const Pose& pose = poses.at(body);
    points[i] = pose.turn * points[i] + pose.shift / unit;
  }
  return points;
}

LoadedMesh MovingTarget::at(double time) const {
  PolygonSoup moved = soup_;
  moved.points = points_at(time);
  return saying_when(time, [&] { return build_target(std::move(moved), case_, mesh_names(case_)); });
}

std::vector<std::string> MovingTarget::warnings(const Sweep& sweep) const {
  std::vector<double> times = sweep.times;
  times.erase(std::unique(times.begin(), times.end()), times.end());
  if (case_.ground && !stands()) {
    PolygonSoup moved = soup_;
    for (const double time : times) {
      moved.points = points_at(time);
      saying_when(time, [&] { stand_on_ground(moved, case_); });
    }
  }
  std::vector<std::string> sentences;
  if (!as_one_) sentences = meetings(times);
  if (const std::string sentence = ambiguity(sweep); !sentence.empty()) sentences.push_back(sentence);
  return sentences;
}

namespace {

// Whether two bodies run into one another: of their triangles those where both are.
bool cross(const TriangleMesh& a, const TriangleMesh& b) {
  const Box box_a = bounding_box(a.vertices), box_b = bounding_box(b.vertices),
            both{glm::max(box_a.low, box_b.low), glm::min(box_a.high, box_b.high)};
  const auto reaches = [](const Box& box, const Box& other) {
    return glm::all(glm::lessThanEqual(box.low, other.high)) && glm::all(glm::lessThanEqual(other.low, box.high));
  };
  if (!reaches(box_a, box_b)) return false;
  TriangleMesh common;  // each body as one patch, of which triangles are never compared
  for (const TriangleMesh* body : {&a, &b}) {
    const auto first = static_cast<std::uint32_t>(common.vertices.size());
    common.vertices.insert(common.vertices.end(), body->vertices.begin(), body->vertices.end());
    for (std::uint32_t t = 0; t < body->triangles.size(); ++t) {
      if (!reaches(bounding_box(body->corners(t)), both)) continue;
      const auto& [i, j, k] = body->triangles[t];
      common.triangles.push_back({i + first, j + first, k + first});
      common.triangle_patch.push_back(body == &a ? 0 : 1);
    }
  }
  if (common.triangles.empty()) return false;
  common.patches.resize(2);
  const auto meet = [&](std::uint32_t i, std::uint32_t j) { return !are_apart(common.corners(i), common.corners(j), 0.0); };
  return !TriangleTree(common).close_pairs(0.0, meet).empty();
}

}  // namespace

// Bodies that touch in the file may do so whenever they like.
std::vector<std::string> MovingTarget::meetings(const std::vector<double>& times) const {
  const std::set<std::size_t> bodies(body_of_polygon_.begin(), body_of_polygon_.end());
  std::vector<std::size_t> numbers;
  std::vector<TriangleMesh> parts;  // in the mesh's own coordinates
  for (const std::size_t body : bodies) {
    try {
      parts.push_back(build_mesh(part_of(soup_, body_of_polygon_, body), case_.metres_per_unit).mesh);
    } catch (const InputError&) {
      continue;  // no facet of it has an area
    }
    for (dvec3& vertex : parts.back().vertices) vertex += parts.back().center;
    numbers.push_back(body);
  }
  using Pair = std::pair<std::size_t, std::size_t>;
  const auto crossing = [&](const std::vector<TriangleMesh>& posed) {
    std::set<Pair> pairs;
    for (std::size_t i = 0; i < posed.size(); ++i)
      for (std::size_t j = i + 1; j < posed.size(); ++j)
        if (carried_by(motion(), numbers[i]) != carried_by(motion(), numbers[j]) && cross(posed[i], posed[j]))
          pairs.insert({i, j});
    return pairs;
  };
  const std::set<Pair> in_file = crossing(parts);
  std::vector<std::set<Pair>> found(times.size());
  tbb::parallel_for(std::size_t{0}, times.size(), [&](std::size_t t) {
    std::vector<TriangleMesh> posed = parts;
    for (std::size_t i = 0; i < posed.size(); ++i) {
      const Pose pose = pose_of(motion(), numbers[i], times[t]);
      for (dvec3& vertex : posed[i].vertices) vertex = pose(vertex);
    }
    found[t] = crossing(posed);
  });
  std::map<Pair, std::pair<double, double>> meeting;  // first and last time
  for (std::size_t t = 0; t < times.size(); ++t)
    for (const Pair& pair : found[t])
      if (!in_file.contains(pair)) meeting.try_emplace(pair, times[t], times[t]).first->second.second = times[t];
  std::vector<std::string> sentences;
  for (const auto& [pair, when] : meeting)
    sentences.push_back(
        fmt::format("{}: {} and {} run into one another from {:.6g} s to {:.6g} s; look at times before, or change "
                    "their paths",
                    case_.motion->location, name_of(motion(), numbers[pair.first]), name_of(motion(), numbers[pair.second]),
                    when.first, when.second));
  return sentences;
}

// Over the corners of a box round each body the path changes most, as over any convex set where the way is straight.
std::string MovingTarget::ambiguity(const Sweep& sweep) const {
  const double shortest = wavelength(std::ranges::max(sweep.frequencies));
  const std::vector<RigidPart> parts = rigid_parts();
  const std::size_t looks = sweep.looks.size() / case_.times();
  double largest = 0.0, interval = 0.0;
  std::size_t fastest = no_body;
  for (std::size_t now = looks, before = 0; now < sweep.looks.size(); ++now, ++before)
    for (const RigidPart& part : parts) {
      const Pose first = pose_of_part(part, sweep.times[before]), then = pose_of_part(part, sweep.times[now]);
      for (const dvec3& at : corners_of(part.box)) {
        const double change = std::abs(Ways(sweep.looks[now]).over(then(at)) - Ways(sweep.looks[before]).over(first(at)));
        if (change > largest) largest = change, interval = sweep.times[now] - sweep.times[before], fastest = part.mover;
      }
    }
  if (largest <= 0.5 * shortest) return {};
  return fmt::format(
      "{}: between times {:.6g} s apart the path over {} changes by up to {:.3g} wavelengths, and beyond "
      "half of one Doppler frequencies are ambiguous; an interval of {:.3g} s would do",
      case_.motion->location, interval, name_of(motion(), fastest), largest / shortest, interval * 0.5 * shortest / largest);
}

}  // namespace raytube
