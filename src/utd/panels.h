// Points along an edge for the integral over its strips and all that follow from them.
#pragma once

#include <span>
#include <vector>

#include "utd/panel_rule.h"
#include "utd/strip_waves.h"
#include "utd/visibility.h"

namespace raytube {

struct EdgePoint {
  dvec3 place;
  double weight;        // [m]; the weights of a lit piece add up to its length
  std::uint32_t panel;  // points of one panel reach the same edges, one strip after another
};

/// How the contributions of an edge turn in phase, for the shortest wavelength of a look.
struct PanelField {
  dvec3 incident, scattered;  // s', s
  double wavelength;
};

/// Cuts the lit pieces of an edge into panels, on each of which every strip, the first and those that follow from it,
/// ends at one edge: there its length is linear in the place on the first edge, and a Gauss rule converges fast. The
/// cuts are the corners of all faces passed, projected back along the strips.
class PanelPlacer {
 public:
  PanelPlacer(std::span<const Wedge> wedges, const Outlines& outlines, const PanelField& field)
      : wedges_(wedges), outlines_(outlines), field_(field) {}

  /// Fills `points` (cleared first) for the strips that `wave` starts on the lit pieces of its edge.
  void place(const StripWave& wave, std::span<const LitInterval> lit, std::vector<EdgePoint>& points);

  /// Whether, at the last place(), one of the waves that go on to further edges ran exactly along an edge of its face.
  bool runs_along_edge() const { return runs_along_edge_; }

 private:
  /// Places on an edge as a function of the place s on the first edge: origin + s step.
  struct EdgeLine {
    dvec3 origin, step;
    dvec3 at(double place) const { return origin + place * step; }
  };
  /// Strips over [from, to] of the first edge that end at the same edge.
  struct Span {
    double from, to;
    double path_rate;              // change of the largest of its phases per metre of the first edge, over k
    double sweep;                  // how far the strips' ends move along them per metre of the first edge
    std::array<bool, 2> vanishes;  // the strips' length, at `from` and at `to`
  };

  void follow(const StripWave& wave, const EdgeLine& line, double from, double to, double path_rate);
  void end(const StripWave& wave, const EdgeLine& line, double from, double to, double path_rate, const OutlineEdge* edge);
  void project_corners(const StripWave& wave, const EdgeLine& line, double from, double to, std::vector<double>& cuts) const;
  void look_aside(const StripWave& wave);
  const OutlineEdge* far_edge(const StripWave& wave, const dvec3& point) const;
  void fill(const EdgeLine& line, std::vector<EdgePoint>& points);
  Panel panel(double from, double to) const;

  std::span<const Wedge> wedges_;
  const Outlines& outlines_;
  PanelField field_;
  double rounding_ = 0.0;  // [m] cuts nearer to one another are one
  std::vector<Span> spans_;
  std::vector<double> cuts_;
  std::vector<PanelPoint> rule_;
  std::uint32_t panels_ = 0;
  bool runs_along_edge_ = false;
};

}  // namespace raytube
