#include "utd/panels.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr double same_place = 1e-9;  // of the edge's length

}  // namespace

void PanelPlacer::place(const StripWave& wave, std::span<const LitInterval> lit, std::vector<EdgePoint>& points) {
  const Wedge& wedge = wedges_[wave.wedge];
  const double length = wedge.length();
  const EdgeLine line{wedge.start, (wedge.end - wedge.start) / length};
  rounding_ = same_place * length;
  points.clear();
  panels_ = 0;
  runs_along_edge_ = false;
  for (const LitInterval& piece : lit) {
    spans_.clear();
    follow(wave, line, piece.begin * length, piece.end * length, glm::dot(field_.scattered - field_.incident, line.step));
    fill(line, points);
  }
}

// The strips of a wave from [from, to]: neighbours between projected corners that end at one edge are taken together.
void PanelPlacer::follow(const StripWave& wave, const EdgeLine& line, double from, double to, double path_rate) {
  if (wave.left > 1) look_aside(wave);
  std::vector<double> cuts;
  project_corners(wave, line, from, to, cuts);
  cuts.push_back(to);
  double begin = from, last = from;
  const OutlineEdge* edge = nullptr;
  for (const double cut : cuts) {
    const OutlineEdge* here = far_edge(wave, line.at((last + cut) / 2));
    if (last > begin && here != edge) {
      end(wave, line, begin, last, path_rate, edge);
      begin = last;
    }
    edge = here;
    last = cut;
  }
  end(wave, line, begin, to, path_rate, edge);
}

void PanelPlacer::end(const StripWave& wave, const EdgeLine& line, double from, double to, double path_rate,
                      const OutlineEdge* edge) {
  if (!edge) {
    spans_.push_back({from, to, std::abs(path_rate), 0.0, {false, false}});
    return;
  }
  const double length = edge->distance(line.origin, wave.direction);
  const double growth = edge->distance(line.origin + line.step, wave.direction) - length;
  const double end_rate = path_rate + (glm::dot(field_.scattered, wave.direction) - 1) * growth;
  const auto vanishes = [&](double place) { return std::abs(length + growth * place) < rounding_; };
  spans_.push_back(
      {from, to, std::max(std::abs(path_rate), std::abs(end_rate)), std::abs(growth), {vanishes(from), vanishes(to)}});
  const auto next = waves_beyond(wedges_, wave, *edge);
  if (!next) return;
  const EdgeLine there{line.origin + length * wave.direction, line.step + growth * wave.direction};
  for (const StripWave& beyond : *next) follow(beyond, there, from, to, end_rate);
}

void PanelPlacer::project_corners(const StripWave& wave, const EdgeLine& line, double from, double to,
                                  std::vector<double>& cuts) const {
  const WedgeFace& face = wedges_[wave.wedge].faces[wave.face];
  const dvec3 across = glm::cross(face.normal, wave.direction);
  const double rate = glm::dot(line.step, across);
  for (const OutlineEdge& edge : outlines_.around(face)) {
    const double place = glm::dot(edge.start - line.origin, across) / rate;
    if (!(place > from + rounding_ && place < to - rounding_)) continue;
    if (glm::dot(edge.start - line.at(place), wave.direction) > 0.0) cuts.push_back(place);
  }
  std::ranges::sort(cuts);
}

void PanelPlacer::look_aside(const StripWave& wave) {
  for (const OutlineEdge& edge : outlines_.around(wedges_[wave.wedge].faces[wave.face]))
    if (edge.wedge != wave.wedge && std::abs(glm::dot(wave.direction, edge.into_face)) < along_edge) runs_along_edge_ = true;
}

const OutlineEdge* PanelPlacer::far_edge(const StripWave& wave, const dvec3& point) const {
  const auto exit = strip_end(wedges_, outlines_, wave, point);
  return exit ? exit->edge : nullptr;
}

void PanelPlacer::fill(const EdgeLine& line, std::vector<EdgePoint>& points) {
  cuts_.clear();
  for (const Span& span : spans_) cuts_.insert(cuts_.end(), {span.from, span.to});
  std::ranges::sort(cuts_);
  double from = cuts_.front();
  const double end = cuts_.back();
  for (const double cut : cuts_) {
    if (cut - from < rounding_ || (cut < end && end - cut < rounding_)) continue;
    rule_.clear();
    add_points(panel(from, cut), field_.wavelength, rule_);
    for (const PanelPoint& point : rule_) points.push_back({line.at(point.place), point.weight, panels_});
    ++panels_;
    from = cut;
  }
}

Panel PanelPlacer::panel(double from, double to) const {
  Panel result{from, to};
  const double middle = (from + to) / 2;
  for (const Span& span : spans_) {
    if (span.from > middle || span.to < middle) continue;
    result.path_rate = std::max(result.path_rate, span.path_rate);
    result.sweep = std::max(result.sweep, span.sweep);
    if (span.vanishes[0] && from - span.from < rounding_) result.root[0] = true;
    if (span.vanishes[1] && span.to - to < rounding_) result.root[1] = true;
  }
  return result;
}

}  // namespace raytube
