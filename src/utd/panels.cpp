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
constexpr double count_slack = 1e-6;         // keeps a count the same when its argument is a whole number but for rounding
constexpr double shortest_panel = 1.0 / 16;  // [wavelengths]; a corner nearer to the last one does not start a new panel
constexpr double inset = 1e-3;               // of a panel, where its two ends are looked at

class Placer {
 public:
  Placer(const StripField& field, const Outlines& outlines, std::vector<EdgePoint>& points)
      : field_(field), outlines_(outlines), points_(points), length_(field.wedge.length()) {
    along_ = (field.wedge.end - field.wedge.start) / length_;
  }

  /// Corners of the face seen along the strips, as distances from the start of the edge, if between `begin` and `end`.
  void project_corners(double begin, double end, std::vector<double>& breaks) const {
    const WedgeFace& face = field_.wedge.faces[field_.face];
    const double slope = glm::dot(field_.direction, along_) / glm::dot(field_.direction, face.into_face);
    for (const OutlineEdge& edge : outlines_.around(face)) {
      const dvec3 offset = edge.start - field_.wedge.start;
      const double across = glm::dot(offset, face.into_face), place = glm::dot(offset, along_) - slope * across;
      if (across > 0.0 && place > begin && place < end) breaks.push_back(place);
    }
    std::ranges::sort(breaks);
  }

  void add_panels(double begin, double end, const std::vector<double>& breaks) {
    const double rounding = 1e-6 * length_, shortest = shortest_panel * field_.wavelength;
    double from = begin;
    for (const double corner : breaks) {
      if (corner - from < rounding || end - corner < rounding) continue;
      if (corner - from + swept(from, corner) < shortest) continue;
      add_panel(from, corner);
      from = corner;
    }
    if (end > from) add_panel(from, end);
  }

 private:
  dvec3 at(double place) const { return field_.wedge.start + place * along_; }

  double strip_length(double place) const {
    return outlines_.exit(field_.wedge.faces[field_.face], field_.wedge_index, at(place), field_.direction).distance;
  }

  /// How far the strips' ends move along the far edge, about.
  double swept(double from, double to) const {
    const double near = strip_length(from + inset * (to - from)), far = strip_length(to - inset * (to - from));
    return std::isfinite(near) && std::isfinite(far) ? std::abs(far - near) : 0.0;
  }

  void add_panel(double from, double to) {
    const double width = to - from, sweep = swept(from, to);
    const double cycles = std::abs(glm::dot(field_.turning, along_)) * width + std::abs(field_.end_turning) * sweep;
    const double wanted =
        least_points + (points_per_cycle * cycles + points_per_wavelength * (width + sweep)) / field_.wavelength;
    const int count = static_cast<int>(std::floor(wanted + count_slack)), parts = (count - 1) / most_gauss_points + 1;
    for (int part = 0; part < parts; ++part)
      for (const GaussPoint& point : gauss_rule((count + parts - 1) / parts))
        points_.push_back({at(from + width * (part + point.place) / parts), width * point.weight / parts});
  }

  const StripField& field_;
  const Outlines& outlines_;
  std::vector<EdgePoint>& points_;
  double length_;
  dvec3 along_;
};

}  // namespace

void place_points(const StripField& field, const Outlines& outlines, std::span<const LitInterval> lit,
                  std::vector<double>& breaks, std::vector<EdgePoint>& points) {
  points.clear();
  Placer placer(field, outlines, points);
  for (const LitInterval& piece : lit) {
    const double begin = piece.begin * field.wedge.length(), end = piece.end * field.wedge.length();
    breaks.clear();
    placer.project_corners(begin, end, breaks);
    placer.add_panels(begin, end, breaks);
  }
}

}  // namespace raytube
