#include "utd/tip/rim_line.h"

#include <algorithm>
#include <cmath>

#include "utd/corner/corner_angles.h"

namespace raytube {

namespace {

// The least step along a rim, and the gap without a nose at which a rim ends, in wavelengths.
constexpr double step_length = 1.0 / 12, longest_gap = 2.0;

// At a distance along a polyline from the tip.
dvec3 point_at(const dvec3& tip, std::span<const RimPlace> rim, double distance) {
  const auto after = std::ranges::lower_bound(rim, distance, {}, &RimPlace::distance);
  if (after == rim.end()) return rim.back().position;
  const bool first = after == rim.begin();
  const double begin = first ? 0.0 : std::prev(after)->distance;
  return glm::mix(first ? tip : std::prev(after)->position, after->position, (distance - begin) / (after->distance - begin));
}

// Places between the tip and the first nose: next to it surfaces have none.
void fill_gap(const dvec3& tip, std::vector<RimPlace>& rim, double step) {
  const RimPlace first = rim.front();
  const int places = static_cast<int>(first.distance / step);
  for (int i = places; i > 0; --i) {
    RimPlace place = first;
    const double share = i / (places + 1.0);
    place.position = glm::mix(tip, first.position, share);
    place.distance = share * first.distance;
    rim.insert(rim.begin(), place);
  }
}

// Tangents and curvatures by chords: those of facets are poor next to the tip.
void straighten(const dvec3& tip, std::vector<RimPlace>& rim, double chord) {
  const std::vector<RimPlace> found = rim;
  const double length = found.back().distance;
  for (RimPlace& place : rim) {
    const double middle = std::clamp(place.distance, chord, length - chord);
    const dvec3 here = point_at(tip, found, middle), before = here - point_at(tip, found, middle - chord),
                after = point_at(tip, found, middle + chord) - here;
    const dvec3 turn = (glm::normalize(after) - glm::normalize(before)) / chord;
    place.tangent = -glm::normalize(before + after + 2.0 * chord * (place.distance - middle) * turn);
    place.outwards = glm::normalize(place.outwards - glm::dot(place.outwards, place.tangent) * place.tangent);
    place.curvature = -glm::dot(turn, place.outwards);
  }
}

// Lengths along chords in place of those from nose to nose, which jitter.
void measure(const dvec3& tip, std::vector<RimPlace>& rim, double chord) {
  const double jittered = rim.back().distance;
  const int pieces = std::max(1, static_cast<int>(jittered / chord));
  double length = 0.0;
  for (int i = 0; i < pieces; ++i)
    length += glm::distance(point_at(tip, rim, jittered * i / pieces), point_at(tip, rim, jittered * (i + 1) / pieces));
  for (RimPlace& place : rim) place.distance *= length / jittered;
}

void share_lengths(std::vector<RimPlace>& rim) {
  double bend = 0.0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const double before = i == 0 ? 0.0 : 0.5 * (rim[i - 1].distance + rim[i].distance);
    const double after = i + 1 < rim.size() ? 0.5 * (rim[i].distance + rim[i + 1].distance) : rim[i].distance;
    rim[i].begin = before;
    rim[i].step = after - before;
    bend += std::cbrt(0.5 * rim[i].curvature * rim[i].curvature) * rim[i].step;
    rim[i].bend = bend;
  }
}

}  // namespace

// The edges of a rim's first noses are within 35 degrees of the line to the tip, and rims are 15 degrees apart at least, as those
// of the flat tips that are solved (utd/corner/corner_angles.h).
std::vector<dvec3> RimTracer::directions_from(const dvec3& tip) const {
  std::vector<const Nose*> near;
  const auto way = [&](const Nose* nose) { return nose->position - tip; };
  for (const Nose& nose : noses_) {
    const double distance = glm::length(way(&nose));
    if (nose.radius > 0.0 && distance > 0.0 && distance < longest_gap * wavelength_ &&
        std::abs(glm::dot(way(&nose), nose.along)) > std::cos(35 * degree) * distance)
      near.push_back(&nose);
  }
  std::ranges::stable_sort(near, {}, [&](const Nose* nose) { return glm::length(way(nose)); });
  std::vector<dvec3> found;
  for (const Nose* nose : near) {
    const dvec3 direction = glm::normalize(way(nose));
    if (std::ranges::all_of(found, [&](const dvec3& d) { return glm::dot(d, direction) < std::cos(least_corner); }))
      found.push_back(direction);
  }
  return found;
}

// The mean of the noses ahead up to a distance; radius 0 if there is none. To the side they are off by 20 degrees at most (its
// tangent is 0.36), or by `jitter`.
RimPlace RimTracer::mean_ahead(const dvec3& at, const dvec3& ahead, double farthest, double jitter) const {
  RimPlace mean{};
  double weight = 0.0;
  for (const Nose& nose : noses_) {
    if (nose.radius <= 0.0) continue;
    const dvec3 way = nose.position - at;
    const double along = glm::dot(way, ahead);
    if (along <= 0.0 || along > farthest) continue;
    if (glm::length(way - along * ahead) > std::max(jitter, 0.36 * along)) continue;
    weight += nose.turn;
    mean.position += nose.turn * nose.position;
    mean.outwards += nose.turn * nose.outwards;
    mean.tangent -= std::copysign(nose.turn, glm::dot(nose.along, ahead)) * nose.along;
    mean.radius += nose.turn * nose.radius;
  }
  if (weight <= 0.0) return mean;
  mean.position /= weight;
  mean.radius /= weight;
  mean.tangent = glm::normalize(mean.tangent);
  mean.outwards = glm::normalize(mean.outwards);
  return mean;
}

// A rim turns by 60 degrees at most from one place to the next.
std::optional<RimPlace> RimTracer::next(const dvec3& at, const dvec3& ahead, double jitter) const {
  for (double farthest = step_length * wavelength_; farthest <= longest_gap * wavelength_; farthest *= 1.5) {
    RimPlace place = mean_ahead(at, ahead, farthest, jitter);
    place.step = glm::distance(place.position, at);
    if (place.radius > 0.0 && place.step >= 0.2 * farthest && glm::dot(-place.tangent, ahead) >= 0.5) return place;
  }
  return std::nullopt;
}

// Where a rim comes as near to its tip again as a tenth of the way it has gone, it is closed. Tangents are those of chords of a
// quarter of the wavelength.
std::vector<RimPlace> RimTracer::trace(const dvec3& tip, const dvec3& direction) const {
  std::vector<RimPlace> rim;
  dvec3 at = tip, ahead = direction;
  double gone = 0.0;
  while (std::optional<RimPlace> place = next(at, ahead, rim.empty() ? 0.0 : 0.5 * step_length * wavelength_)) {
    place->distance = gone += place->step;
    if (!rim.empty() && glm::distance(place->position, tip) < 0.1 * gone) break;
    at = place->position, ahead = -place->tangent;
    rim.push_back(*place);
  }
  const double chord = 1.0 / 4 * wavelength_;
  if (rim.empty() || gone < 2 * chord) return {};
  fill_gap(tip, rim, step_length * wavelength_);
  straighten(tip, rim, chord);
  measure(tip, rim, chord);
  share_lengths(rim);
  return rim;
}

}  // namespace raytube
