#include "case/moving_target.h"

#include <fmt/format.h>

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
#include "mesh/model/join.h"
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

MovingTarget::MovingTarget(PolygonSoup soup, const Case& c) : case_(c), motion_(c.motion->motion), soup_(std::move(soup)) {
  case_.sweep.looks.clear(), case_.sweep.times.clear();
  body_of_polygon_ = bodies_of(soup_, *c.motion);
  std::set<std::size_t> movers;
  for (const std::size_t body : body_of_polygon_) movers.insert(carried_by(motion_, body));
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
      boxes[carried_by(motion_, body_of_polygon_[i])].add(soup_.points[corner] * case_.metres_per_unit);
  std::vector<RigidPart> parts;
  for (const auto& [mover, box] : boxes) parts.push_back({mover, box});
  return parts;
}

LoadedMesh MovingTarget::at_rest() const { return build_target(soup_, case_, mesh_names(case_)); }

std::vector<dvec3> MovingTarget::points_at(double time) const {
  std::map<std::size_t, Pose> poses;
  for (std::size_t body = 0; body < motion_.bodies.size(); ++body) poses.emplace(body, pose_of(motion_, body, time));
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
  try {
    return build_target(std::move(moved), case_, mesh_names(case_));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} (at {:.9g} s)", error.what(), time));
  }
}

std::vector<std::string> MovingTarget::warnings(const Sweep& sweep) const {
  std::vector<double> times = sweep.times;
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<std::string> sentences;
  if (!as_one_) sentences = meetings(times);
  if (const std::string sentence = ambiguity(sweep); !sentence.empty()) sentences.push_back(sentence);
  return sentences;
}

// Bodies that touch in the file may do so whenever they like.
std::vector<std::string> MovingTarget::meetings(const std::vector<double>& times) const {
  std::set<std::size_t> bodies(body_of_polygon_.begin(), body_of_polygon_.end());
  std::vector<std::size_t> numbers(bodies.begin(), bodies.end());
  std::vector<TriangleMesh> parts;
  for (const std::size_t body : numbers)
    parts.push_back(build_mesh(part_of(soup_, body_of_polygon_, body), case_.metres_per_unit).mesh);
  using Pair = std::pair<std::size_t, std::size_t>;
  const auto crossing_at = [&](const std::vector<Pose>& poses) {
    std::vector<TriangleMesh> posed = parts;
    std::vector<Box> boxes(parts.size());
    for (std::size_t i = 0; i < posed.size(); ++i) {
      const Pose& pose = poses[i];
      for (dvec3& v : posed[i].vertices) boxes[i].add((v = pose.turn * v) + pose(posed[i].center));
      posed[i].center = pose(posed[i].center);
    }
    std::set<Pair> crossing;
    for (std::size_t i = 0; i < posed.size(); ++i)
      for (std::size_t j = i + 1; j < posed.size(); ++j) {
        if (glm::any(glm::greaterThan(boxes[i].low, boxes[j].high)) || glm::any(glm::greaterThan(boxes[j].low, boxes[i].high)))
          continue;
        const std::array both{posed[i], posed[j]};
        const JoinedMesh joined = join_meshes(both);
        const auto cross = [&](std::uint32_t a, std::uint32_t b) {
          return joined.triangle_part[a] != joined.triangle_part[b] &&
                 !are_apart(joined.mesh.corners(a), joined.mesh.corners(b), 0.0);
        };
        if (!TriangleTree(joined.mesh).close_pairs(0.0, cross).empty()) crossing.insert({i, j});
      }
    return crossing;
  };
  const std::set<Pair> in_file = crossing_at(std::vector<Pose>(parts.size()));
  std::map<Pair, std::pair<double, double>> meeting;  // first and last time
  for (const double time : times) {
    std::vector<Pose> poses;
    for (const std::size_t body : numbers) poses.push_back(pose_of(motion_, body, time));
    for (const Pair& pair : crossing_at(poses))
      if (!in_file.contains(pair)) meeting.try_emplace(pair, time, time).first->second.second = time;
  }
  std::vector<std::string> sentences;
  for (const auto& [pair, when] : meeting)
    sentences.push_back(
        fmt::format("{}: {} and {} run into one another from {:.6g} s to {:.6g} s; look at times before, or change "
                    "their paths",
                    case_.motion->location, name_of(motion_, numbers[pair.first]), name_of(motion_, numbers[pair.second]),
                    when.first, when.second));
  return sentences;
}

// Over the corners of a box round each body the path changes most, as over any convex set where the way is straight.
std::string MovingTarget::ambiguity(const Sweep& sweep) const {
  const double shortest = wavelength(std::ranges::max(sweep.frequencies));
  const std::vector<RigidPart> parts = rigid_parts();
  const std::size_t looks = case_.motion->times() > 0 ? sweep.looks.size() / case_.motion->times() : 0;
  double largest = 0.0, interval = 0.0;
  std::size_t fastest = no_body;
  for (std::size_t now = looks, before = 0; now < sweep.looks.size(); ++now, ++before)
    for (const RigidPart& part : parts) {
      const Pose first = pose_of_part(part, sweep.times[before]), then = pose_of_part(part, sweep.times[now]);
      for (const dvec3& at : corners_of(part.box)) {
        const double change = std::abs(path_over(sweep.looks[now], then(at)) - path_over(sweep.looks[before], first(at)));
        if (change > largest) largest = change, interval = sweep.times[now] - sweep.times[before], fastest = part.mover;
      }
    }
  if (largest <= 0.5 * shortest) return {};
  return fmt::format(
      "{}: between times {:.6g} s apart the path over {} changes by up to {:.3g} wavelengths, and beyond "
      "half of one Doppler frequencies are ambiguous; an interval of {:.3g} s would do",
      case_.motion->location, interval, name_of(motion_, fastest), largest / shortest, interval * 0.5 * shortest / largest);
}

}  // namespace raytube
