#include "utd/panels.h"

#include <algorithm>
#include <cmath>

#include "utd/gauss.h"

namespace raytube {

namespace {

// A rule of N points integrates N 2/pi cycles of phase and a little more; the rest of the strips' variation is smooth.
constexpr double least_points = 4.0;
constexpr double points_per_cycle = 1.6;
constexpr double points_per_wavelength = 1.0;
constexpr double count_slack = 1e-6;  // keeps a count the same when its argument is a whole number but for rounding
constexpr double same_place = 1e-9;   // of the edge's length

}  // namespace

void PanelPlacer::place(const StripWave& wave, std::span<const LitInterval> lit, std::vector<EdgePoint>& points) {
  const Wedge& wedge = wedges_[wave.wedge];
  const double length = wedge.length();
  const EdgeLine line{wedge.start, (wedge.end - wedge.start) / length};
  rounding_ = same_place * length;
  points.clear();
  panels_ = 0;
  for (const LitInterval& piece : lit) {
    spans_.clear();
    follow(wave, line, piece.begin * length, piece.end * length, glm::dot(field_.scattered - field_.incident, line.step), 0);
    fill(line, points);
  }
}

// The strips of a wave from [from, to]: neighbours between projected corners that end at one edge are taken together.
void PanelPlacer::follow(const StripWave& wave, const EdgeLine& line, double from, double to, double path_rate, int level) {
  std::vector<double> cuts;
  project_corners(wave, line, from, to, cuts);
  cuts.push_back(to);
  double begin = from, last = from;
  const OutlineEdge* edge = nullptr;
  for (const double cut : cuts) {
    const OutlineEdge* here = far_edge(wave, line.at((last + cut) / 2));
    if (last > begin && here != edge) {
      end(wave, line, begin, last, path_rate, level, edge);
      begin = last;
    }
    edge = here;
    last = cut;
  }
  end(wave, line, begin, to, path_rate, level, edge);
}

void PanelPlacer::end(const StripWave& wave, const EdgeLine& line, double from, double to, double path_rate, int level,
                      const OutlineEdge* edge) {
  if (!edge) {
    spans_.push_back({from, to, std::abs(path_rate), 0.0});
    return;
  }
  const double length = edge->distance(line.origin, wave.direction);
  const double growth = edge->distance(line.origin + line.step, wave.direction) - length;
  const double end_rate = path_rate + (glm::dot(field_.scattered, wave.direction) - 1) * growth;
  spans_.push_back({from, to, std::max(std::abs(path_rate), std::abs(end_rate)), std::abs(growth)});
  if (level + 1 == field_.order) return;
  const auto next = waves_beyond(wedges_, wave, *edge);
  if (!next) return;
  const EdgeLine there{line.origin + length * wave.direction, line.step + growth * wave.direction};
  for (const StripWave& beyond : *next) follow(beyond, there, from, to, end_rate, level + 1);
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
    add_panel(line, from, cut, points);
    from = cut;
  }
}

void PanelPlacer::add_panel(const EdgeLine& line, double from, double to, std::vector<EdgePoint>& points) {
  const double width = to - from, middle = (from + to) / 2;
  double path_rate = 0.0, sweep = 0.0;
  for (const Span& span : spans_) {
    if (span.from > middle || span.to < middle) continue;
    path_rate = std::max(path_rate, span.path_rate);
    sweep = std::max(sweep, span.sweep);
  }
  const double wanted =
      least_points + (points_per_cycle * path_rate + points_per_wavelength * (1 + sweep)) * width / field_.wavelength;
  const int count = static_cast<int>(std::floor(wanted + count_slack)), parts = (count - 1) / most_gauss_points + 1;
  for (int part = 0; part < parts; ++part)
    for (const GaussPoint& point : gauss_rule((count + parts - 1) / parts))
      points.push_back({line.at(from + width * (part + point.place) / parts), width * point.weight / parts, panels_});
  ++panels_;
}

}  // namespace raytube
