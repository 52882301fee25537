#include "utd/surface/shadow_boundary.h"

#include <algorithm>
#include <cmath>

#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// The boundary over one facet.
struct Crossing {
  std::uint32_t triangle;
  std::array<dvec2, 2> ends;               // barycentric coordinates
  std::array<dvec3, 2> points;             // where these ends are [m]
  std::array<std::uint32_t, 2> neighbour;  // the crossing beyond each end, no_index: none
  double measure;                          // in pieces of the boundary
};

class ShadowBoundary {
 public:
  ShadowBoundary(const CurvedTarget& target, const LocalLook& look, double widest, double most_turn)
      : target_(target), look_(look), widest_(widest), most_turn_(most_turn) {
    for (std::uint32_t t = 0; t < target.tracer.mesh().triangles.size(); ++t)
      if (target.carries_waves(t)) cross(t);
    link();
  }

  std::vector<BoundaryLine> take() {
    done_.assign(crossings_.size(), false);
    for (std::uint32_t i = 0; i < crossings_.size(); ++i)
      if (!done_[i]) add_line(line_through(i));
    return std::move(lines_);
  }

 private:
  // A crossing as it is passed along a line: from its end `first` to the other one.
  struct Pass {
    std::uint32_t crossing;
    int first;
  };
  struct EdgeEnd {
    std::uint32_t edge, crossing;
    int end;
  };

  void cross(std::uint32_t t) {
    double f[3];
    for (int c = 0; c < 3; ++c) f[c] = target_.facing(t, c, look_.incident(target_.corner(t, c)));
    const int dark = (f[0] > 0) + (f[1] > 0) + (f[2] > 0);
    if (dark == 0 || dark == 3) return;
    Crossing crossing{t, {}, {}, {no_index, no_index}, 0.0};
    std::array<dvec3, 2> normals;
    int found = 0;
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3;
      if ((f[c] > 0) != (f[next] > 0)) normals[found] = end_on_side(c, f[c] / (f[c] - f[next]), crossing, found), ++found;
    }
    crossing.measure = std::max(glm::distance(crossing.points[0], crossing.points[1]) / widest_,
                                glm::distance(normals[0], normals[1]) / most_turn_);
    crossings_.push_back(crossing);
  }

  // At fraction x of the side from corner c; the normal there.
  dvec3 end_on_side(int c, double x, Crossing& crossing, int end) {
    const int next = (c + 1) % 3;
    double l[3] = {};
    l[c] = 1.0 - x, l[next] = x;
    const std::uint32_t t = crossing.triangle;
    crossing.ends[end] = {l[1], l[2]};
    crossing.points[end] = target_.surfaces.facet(t).point(crossing.ends[end]);
    if (!target_.surfaces.on_boundary(t, c))
      edge_ends_.push_back({target_.tracer.mesh().edges().edge_of(t, c), static_cast<std::uint32_t>(crossings_.size()), end});
    return glm::normalize(glm::mix(target_.curvatures.normal(t, c), target_.curvatures.normal(t, next), x));
  }

  void link() {
    std::ranges::sort(edge_ends_, {}, [](const EdgeEnd& e) { return std::pair(e.edge, e.crossing); });
    for (std::size_t i = 0; i + 1 < edge_ends_.size(); ++i) {
      const EdgeEnd &a = edge_ends_[i], &b = edge_ends_[i + 1];
      if (a.edge != b.edge) continue;
      crossings_[a.crossing].neighbour[a.end] = b.crossing;
      crossings_[b.crossing].neighbour[b.end] = a.crossing;
    }
  }

  // The one beyond the end of a pass.
  Pass after(const Pass& pass) const {
    const std::uint32_t next = crossings_[pass.crossing].neighbour[1 - pass.first];
    if (next == no_index) return {no_index, 0};
    return {next, crossings_[next].neighbour[0] == pass.crossing ? 0 : 1};
  }

  // The whole line, from its one end to the other, or once round.
  std::vector<Pass> line_through(std::uint32_t start) {
    Pass pass{start, 0};
    while (true) {  // back to an end
      const Pass before = after({pass.crossing, 1 - pass.first});
      if (before.crossing == no_index || before.crossing == start) break;
      pass = {before.crossing, 1 - before.first};
    }
    std::vector<Pass> line;
    for (; pass.crossing != no_index && !done_[pass.crossing]; pass = after(pass)) {
      done_[pass.crossing] = true;
      line.push_back(pass);
    }
    return line;
  }

  const dvec3& begin(const Pass& pass) const { return crossings_[pass.crossing].points[pass.first]; }

  // The mean of a closed line's points.
  dvec3 centroid(const std::vector<Pass>& line) const {
    dvec3 sum(0.0);
    double length = 0.0;
    for (const Pass& pass : line) {
      const auto& [a, b] = crossings_[pass.crossing].points;
      sum += glm::distance(a, b) * 0.5 * (a + b);
      length += glm::distance(a, b);
    }
    return sum / length;
  }

  // The place of the vertex of a parabola through three points, from the middle one on, within half-way to the others.
  static double vertex(double before, double after, double rise, double fall) {
    if (before <= 0.0 || after <= 0.0) return 0.0;
    const double curvature = rise / before + fall / after;
    if (!(curvature > 0.0)) return 0.0;
    const double slope = (rise / before * after - fall / after * before) / (before + after);
    return std::clamp(0.5 * slope * (before + after) / curvature, -0.5 * before, 0.5 * after);
  }

  // Where a closed line is farthest from its centroid, as measures: the places where its stretches meet, several if it is its own
  // image. They are the same whichever crossing comes first and however body and look are turned, mirror images have mirror
  // images of them, and they go along as the look turns. A line that is its own image more often than it has pieces is a circle,
  // wherever they begin.
  std::vector<double> joints(const std::vector<Pass>& line, const std::vector<double>& sums) const {
    const dvec3 centre = centroid(line);
    std::vector<double> distances;
    for (const Pass& pass : line) distances.push_back(glm::distance(begin(pass), centre));
    const double farthest = std::ranges::max(distances) - rounding_guard * target_.tracer.mesh().radius;
    std::vector<double> found;
    for (std::size_t i = 0, count = line.size(); i < count; ++i) {
      if (distances[i] < farthest) continue;
      const std::size_t last = (i + count - 1) % count, next = (i + 1) % count;
      const double before = crossings_[line[last].crossing].measure, after = crossings_[line[i].crossing].measure;
      const double turn = vertex(before, after, distances[i] - distances[last], distances[i] - distances[next]);
      found.push_back(std::fmod(sums[i] + turn + sums.back(), sums.back()));
    }
    if (static_cast<double>(found.size()) > std::max(1.0, sums.back())) found.resize(1);
    std::ranges::sort(found);
    return found;
  }

  void add_line(const std::vector<Pass>& line) {
    std::vector<double> sums{0.0};
    std::vector<BoundaryLine::Crossing> crossings;
    for (const auto& [number, first] : line) {
      const Crossing& c = crossings_[number];
      sums.push_back(sums.back() + c.measure);
      crossings.push_back({c.triangle, {c.ends[first], c.ends[1 - first]}, {c.points[first], c.points[1 - first]}, c.measure});
    }
    if (sums.back() <= 0.0) return;
    const bool closed = after(line.back()).crossing == line.front().crossing;
    std::vector<double> ends = closed ? joints(line, sums) : std::vector<double>{0.0};
    ends.push_back(ends.front() + sums.back());
    lines_.emplace_back(std::move(crossings), closed, std::move(ends));
  }

  const CurvedTarget& target_;
  const LocalLook& look_;
  const double widest_, most_turn_;
  std::vector<Crossing> crossings_;
  std::vector<EdgeEnd> edge_ends_;
  std::vector<bool> done_;
  std::vector<BoundaryLine> lines_;
};

}  // namespace

BoundaryLine::BoundaryLine(std::vector<Crossing> crossings, bool closed, std::vector<double> ends)
    : crossings_(std::move(crossings)), closed_(closed), ends_(std::move(ends)) {
  for (const Crossing& crossing : crossings_) {
    sums_.push_back(sums_.back() + crossing.measure);
    lengths_.push_back(lengths_.back() + glm::distance(crossing.points[0], crossing.points[1]));
  }
}

std::vector<BoundaryPiece> BoundaryLine::pieces() const {
  std::vector<BoundaryPiece> pieces;
  for (std::size_t i = 0; i + 1 < ends_.size(); ++i) {
    const double parts = part_count(ends_[i + 1] - ends_[i]), part = (ends_[i + 1] - ends_[i]) / parts;
    for (double n = 0.0; n < parts && part > rounding_guard; ++n)
      pieces.push_back(piece(ends_[i] + n * part, ends_[i] + (n + 1.0) * part));
  }
  return pieces;
}

BoundaryPiece BoundaryLine::piece(double from, double to) const {
  const Place middle = place(0.5 * (from + to));
  return {middle.on, place(to).position - place(from).position, from, to, middle.arc_length};
}

// Rounding may put the last place of an open line beyond its end.
BoundaryLine::Place BoundaryLine::place(double at) const {
  const double all = sums_.back(), round = closed_ ? std::floor(at / all) : 0.0, here = at - round * all;
  const auto after = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, here);
  const auto number = static_cast<std::size_t>(after - sums_.begin() - 1);
  const Crossing& crossing = crossings_[number];
  const double share = crossing.measure > 0.0 ? std::clamp((here - *(after - 1)) / crossing.measure, 0.0, 1.0) : 0.0;
  return {{crossing.triangle, glm::mix(crossing.ends[0], crossing.ends[1], share)},
          glm::mix(crossing.points[0], crossing.points[1], share),
          round * lengths_.back() + glm::mix(lengths_[number], lengths_[number + 1], share)};
}

std::vector<BoundaryLine> shadow_boundary(const CurvedTarget& target, const LocalLook& look, double widest, double most_turn) {
  return ShadowBoundary(target, look, widest, most_turn).take();
}

}  // namespace raytube
