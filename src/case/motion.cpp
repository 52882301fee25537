#include "case/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/directions/radar.h"
#include "case/directions/row_limit.h"
#include "case/poses.h"
#include "case/text/keys.h"
#include "case/text/values.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

std::string path_of(const BodyMotion& body, const char* key) {
  return fmt::format("motion.bodies.{}.{}", quotable(body.name), key);
}

// The names in the mesh that a body consists of: one or a list.
std::vector<std::string> read_parts(const CaseValue& value, const std::string& key) {
  std::vector<std::string> parts;
  if (value.kind == CaseValue::Kind::list) {
    if (value.items.empty()) reject(value, fmt::format("{} is an empty list; give at least one name, or remove it", key));
    for (const CaseValue& item : value.items) parts.push_back(read_text(item, "every entry of " + key));
  } else {
    parts.push_back(read_text(value, key));
  }
  return parts;
}

void read_turning(const CaseValue& section, BodyMotion& body) {
  const CaseValue *rev = section.find("rev_per_min"), *rate = section.find("deg_per_s"), *angle = section.find("angle_deg");
  if (rev && rate) reject(*rate, fmt::format("{} and rev_per_min say the same; remove one", path_of(body, "deg_per_s")));
  if (!rev && !rate && !angle) {
    for (const char* key : {"axis", "through_m"})
      if (const CaseValue* value = section.find(key))
        reject(*value, fmt::format("{} turns nothing; add rev_per_min, deg_per_s or angle_deg", path_of(body, key)));
    return;
  }
  Turning turning;
  const CaseValue* axis = section.find("axis");
  if (!axis)
    reject(rev    ? *rev
           : rate ? *rate
                  : *angle,
           fmt::format("{} is missing; write for example axis = [0, 0, 1]", path_of(body, "axis")));
  turning.axis = read_vector(*axis, path_of(body, "axis"));
  const double length = glm::length(turning.axis);
  if (!(length > 0.0))
    reject(*axis, fmt::format("{} must not be the zero vector; write for example [0, 0, 1]", path_of(body, "axis")));
  turning.axis /= length;
  if (const CaseValue* through = section.find("through_m")) turning.through = read_vector(*through, path_of(body, "through_m"));
  if (rev) turning.rate = read_number(*rev, path_of(body, "rev_per_min")) * 6.0 * degree;
  if (rate) turning.rate = read_number(*rate, path_of(body, "deg_per_s")) * degree;
  if (angle) turning.angle = read_number(*angle, path_of(body, "angle_deg")) * degree;
  body.turning = turning;
}

// A table has all the times that the case asks for.
void check_times(const CaseValue& value, const std::string& key, const std::vector<PoseSample>& poses, const Case& c) {
  for (const double time : c.sweep.times)
    if (time < poses.front().time || time > poses.back().time)
      reject(value, fmt::format("{} has poses from {:.9g} s to {:.9g} s, but [motion] asks for {:.9g} s; add rows", key,
                                poses.front().time, poses.back().time, time));
}

BodyMotion read_body(const CaseValue& section, const std::string& name, Case& c) {
  BodyMotion body;
  body.name = name;
  if (const CaseValue* parts = section.find("parts")) body.parts = read_parts(*parts, path_of(body, "parts"));
  if (const CaseValue* velocity = section.find("velocity_m_per_s"))
    body.velocity = read_vector(*velocity, path_of(body, "velocity_m_per_s"));
  read_turning(section, body);
  const CaseValue *table = section.find("poses_csv"), *list = section.find("poses");
  if (table && list)
    reject(*list, {table}, fmt::format("{} and poses_csv both say where; remove one of them", path_of(body, "poses")));
  if (table) {
    body.poses_csv = read_file_name(*table, path_of(body, "poses_csv"), "table of poses");
    body.poses = read_poses_csv(c.file.parent_path() / body.poses_csv, path_of(body, "poses_csv"));
  }
  if (list) body.poses = read_pose_list(*list, path_of(body, "poses"));
  if (!body.poses.empty()) check_times(table ? *table : *list, path_of(body, table ? "poses_csv" : "poses"), body.poses, c);
  return body;
}

// Which body carries which. None carries itself.
void read_carriers(const CaseValue& section, Motion& motion) {
  std::vector<std::string> names;
  for (const BodyMotion& body : motion.bodies) names.push_back(body.name);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const CaseValue* on = section.items[i].find("on");
    if (!on) continue;
    const std::string key = path_of(motion.bodies[i], "on"), carrier = read_text(*on, key);
    const auto found = std::ranges::find(names, carrier);
    if (found == names.end())
      reject(*on, fmt::format("{} \"{}\" is not in [motion.bodies]; {}", key, quotable(carrier), name_meant(carrier, names)));
    motion.bodies[i].on = static_cast<std::size_t>(found - names.begin());
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::size_t at = i;
    for (std::size_t steps = 0; at != no_body; at = motion.bodies[at].on)
      if (++steps > names.size())
        reject(*section.items[i].find("on"),
               fmt::format("{}: bodies carry one another in a circle; let one of them stand on none",
                           path_of(motion.bodies[i], "on")));
  }
}

// Each name in one body; what no body names goes to the one without names.
void check_parts(const CaseValue& section, const Motion& motion) {
  const BodyMotion* rest = nullptr;
  for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
    const BodyMotion& body = motion.bodies[i];
    if (body.parts.empty()) {
      if (rest)
        reject(section.items[i],
               fmt::format("motion.bodies.{} and motion.bodies.{} both name no parts; only one can have what is left",
                           quotable(rest->name), quotable(body.name)));
      rest = &body;
    }
    for (const std::string& part : body.parts)
      for (std::size_t j = 0; j < i; ++j)
        if (std::ranges::find(motion.bodies[j].parts, part) != motion.bodies[j].parts.end())
          reject(*section.items[i].find("parts"),
                 fmt::format("{}: \"{}\" belongs to motion.bodies.{} already; remove one", path_of(body, "parts"), quotable(part),
                             quotable(motion.bodies[j].name)));
  }
}

// Where the antennas move.
BodyMotion read_track(const CaseValue& section, const CaseValue& root, const Case& c) {
  const CaseValue *velocity = section.find("velocity_m_per_s"), *track = section.find("track_csv");
  if (!has_positions(root))
    reject(section,
           "[motion.radar] moves antennas from radar.position_m, which is missing; at infinity there is only a direction");
  if ((velocity != nullptr) == (track != nullptr))
    reject(section, "[motion.radar] needs velocity_m_per_s or track_csv, one of the two");
  BodyMotion radar;
  if (velocity) radar.velocity = read_vector(*velocity, "motion.radar.velocity_m_per_s");
  if (!track) return radar;
  radar.poses_csv = read_file_name(*track, "motion.radar.track_csv", "track");
  radar.poses = read_poses_csv(c.file.parent_path() / radar.poses_csv, "motion.radar.track_csv", false);
  check_times(*track, "motion.radar.track_csv", radar.poses, c);
  return radar;
}

// A track says where radar.position_m goes: its first line is that place, whatever it counts from.
dvec3 displacement(const BodyMotion& radar, double time, double reference) {
  const Motion alone{{radar}, reference};
  const dvec3 at = pose_of(alone, 0, time).shift;
  return radar.poses.empty() ? at : at - radar.poses.front().position;
}

double required(const CaseValue& pulses, const char* key) {
  const CaseValue* value = pulses.find(key);
  if (!value)
    reject(pulses,
           fmt::format("motion.pulses.{} is missing; write pulses = {{ start_s = 0.0, interval_s = 1e-4, count = 256 }}", key));
  return read_number(*value, fmt::format("motion.pulses.{}", key));
}

void read_pulses(const CaseValue& pulses, MotionChoice& choice) {
  if (pulses.kind != CaseValue::Kind::table)
    reject(pulses, "motion.pulses must be a table; write pulses = { start_s = 0.0, interval_s = 1e-4, count = 256 }");
  const std::vector<std::string> known{"start_s", "interval_s", "count"};
  for (std::size_t i = 0; i < pulses.keys.size(); ++i)
    if (std::ranges::find(known, pulses.keys[i]) == known.end())
      reject(pulses.items[i],
             fmt::format("unknown key \"motion.pulses.{}\"; {}", quotable(pulses.keys[i]), name_meant(pulses.keys[i], known)));
  if (pulses.find("start_s")) choice.start_s = required(pulses, "start_s");
  choice.interval_s = required(pulses, "interval_s");
  if (!(choice.interval_s > 0.0)) reject(*pulses.find("interval_s"), "motion.pulses.interval_s must be greater than 0");
  required(pulses, "count");
  choice.pulses =
      static_cast<std::size_t>(read_whole(*pulses.find("count"), "motion.pulses.count", {.least = 1.0, .most = most_rows}));
}

void read_times(const CaseValue& section, MotionChoice& choice, Case& c) {
  const CaseValue *pulses = section.find("pulses"), *times = section.find("times_s");
  if (pulses && times) reject(*times, {pulses}, "motion.times_s and motion.pulses both say when; remove one of them");
  if (pulses) {
    read_pulses(*pulses, choice);
    for (std::size_t i = 0; i < choice.pulses; ++i)
      c.sweep.times.push_back(choice.start_s + static_cast<double>(i) * choice.interval_s);
  } else if (times) {
    c.sweep.times = choice.times_s = read_values(*times, "motion.times_s", c.warnings);
  } else {
    reject(section, "[motion] does not say when; add pulses = { start_s = 0.0, interval_s = 1e-4, count = 256 }, or times_s");
  }
  if (std::ranges::adjacent_find(c.sweep.times, std::ranges::greater_equal()) != c.sweep.times.end())
    reject(times ? *times : *pulses,
           times ? "motion.times_s must ascend; sort them, and give each once"
                 : "motion.pulses.interval_s must be longer than what numbers as large as start_s tell apart; "
                   "start at 0");
}

}  // namespace

void read_motion(const CaseValue& root, Case& c) {
  const CaseValue* section = root.find("motion");
  if (!section) return;
  MotionChoice choice;
  choice.location = section->location;
  read_times(*section, choice, c);
  if (const CaseValue* reference = section->find("reference_s"))
    choice.motion.reference = read_number(*reference, "motion.reference_s");
  if (const CaseValue* retrace = section->find("retrace"))
    choice.retrace = read_word(*retrace, "motion.retrace", retrace_words) == 0;
  if (!choice.retrace && c.incoherent)
    reject(*find(root, "motion.retrace"), {find(root, "output.incoherent")},
           "motion.retrace \"auto\" follows phases, which output.incoherent has none of; write \"every\", or remove that");
  if (const CaseValue* bodies = section->find("bodies")) {
    for (std::size_t i = 0; i < bodies->keys.size(); ++i)
      choice.motion.bodies.push_back(read_body(bodies->items[i], bodies->keys[i], c));
    read_carriers(*bodies, choice.motion);
    check_parts(*bodies, choice.motion);
  }
  if (!c.radar.turntable_deg.empty())
    reject(*find(root, "radar.turntable_deg"), {section},
           "radar.turntable_deg cannot be combined with [motion]; write the turning as a body, with axis = [0, 0, 1]");
  if (const CaseValue* images = find(root, "output.image_look"))
    reject(*images, {section}, "output.image_look needs a scene that stands; remove it, or [motion]");
  check_rows(*section, static_cast<double>(c.sweep.looks.size()) * static_cast<double>(c.sweep.times.size()),
             c.sweep.frequencies.size());
  if (const CaseValue* radar = section->find("radar")) {
    choice.radar = read_track(*radar, root, c);
    if (const CaseValue* aim = radar->find("aim_moves")) choice.aim_moves = read_flag(*aim, "motion.radar.aim_moves");
  }
  const std::vector<Look> looks = std::move(c.sweep.looks);
  const std::vector<double> times = std::move(c.sweep.times);
  c.sweep.looks.clear(), c.sweep.times.clear();
  for (const double time : times) {
    const dvec3 way = choice.radar ? displacement(*choice.radar, time, choice.motion.reference) : dvec3(0.0);
    for (const Look& look : looks) {
      Look& then = c.sweep.looks.emplace_back(look);
      if (choice.radar) then = look_between(look.transmitter().point() + way, look.receiver().point() + way);
      if (choice.aim_moves) then.aim_way = way;
      c.sweep.times.push_back(time);
    }
  }
  c.motion = std::move(choice);
}

std::vector<std::string> pose_tables(const Case& c) {
  std::vector<std::string> tables;
  if (!c.motion) return tables;
  std::vector<BodyMotion> bodies = c.motion->motion.bodies;
  if (c.motion->radar) bodies.push_back(*c.motion->radar);
  for (const BodyMotion& body : bodies)
    if (!body.poses_csv.empty()) tables.push_back(body.poses_csv);
  return tables;
}

}  // namespace raytube
