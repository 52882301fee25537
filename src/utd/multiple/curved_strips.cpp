#include "utd/multiple/curved_strips.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "utd/multiple/strip_walk.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

constexpr double panel_length = 0.33;    // of the wavelength, with two points
constexpr double short_panel = 1.0 / 6;  // with one point
constexpr double ends_apart = 0.5;       // of the wavelength
constexpr int most_halvings = 4;

// Strips that meet an edge at a smaller angle than that run along it: what starts there grows as its inverse, while the share of
// strips that do falls with it. Single points of a quadrature know the one and not the other.
constexpr double least_sine = 0.02;

bool runs_along(const OutlineEdge& edge, const dvec3& direction) { return -glm::dot(direction, edge.into_face) < least_sine; }

void start_next(const StripScene& scene, StripPath& path, const OutlineEdge& edge, const dvec3& direction) {
  if (runs_along(edge, direction)) return;
  StripWave arriving = path.wave;
  arriving.direction = direction;
  const auto next = waves_beyond(scene.wedges, arriving, edge);
  if (!next) return;
  for (const StripWave& wave : *next) path.next.push_back(strip_path(scene, wave, path.end));
}

StripPath path_of(const StripScene& scene, const StripWave& wave, const dvec3& point) {
  const double half_cosine = grazing_half_cosine(wave.across, wave.incidence, scene.look.scattered);
  return {wave,
          point,
          Strip(scene.wedges[wave.source].n, wave.incidence, half_cosine),
          face_projection(wave, scene.look),
          {},
          0.0,
          point,
          glm::dot(scene.look.scattered, wave.direction) - 1.0,
          {}};
}

OutlineEdge edge_of(const StripScene& scene, const WedgeSide& at) {
  OutlineEdge edge;
  edge.into_face = scene.wedges[at.wedge].faces[at.face].into_face;
  edge.wedge = at.wedge;
  edge.wedge_face = at.face;
  return edge;
}

dvec3 in_face(const StripScene& scene, const WedgeSide& at, const dvec3& direction) {
  const dvec3& normal = scene.wedges[at.wedge].faces[at.face].normal;
  return glm::normalize(direction - glm::dot(direction, normal) * normal);
}

void follow_flat(const StripScene& scene, StripPath& path) {
  const WedgeFace& face = scene.wedges[path.wave.wedge].faces[path.wave.face];
  const OutlineEdge* edge = strip_end(scene.outlines, face, path.wave, path.start);
  path.length = edge ? std::max(edge->distance(path.start, path.wave.direction), 0.0) : std::numeric_limits<double>::infinity();
  if (!edge) return;
  path.end = path.start + path.length * path.wave.direction;
  if (path.wave.goes_on()) start_next(scene, path, *edge, path.wave.direction);
}

void follow_curved(const StripScene& scene, StripPath& path) {
  const StripArrival end = walk_strip(scene, path);
  if (end.at.wedge == no_index || !path.wave.goes_on()) return;
  start_next(scene, path, edge_of(scene, end.at), in_face(scene, end.at, end.direction));
}

bool end_apart(const StripPath& a, const StripPath& b, double wavelength) {
  return glm::distance(a.end, b.end) > ends_apart * wavelength + glm::distance(a.start, b.start);
}

/// The strips of a first wave and where they start.
class FirstStrips {
 public:
  FirstStrips(const StripScene& scene, const StripWave& wave, std::vector<PanelPoint>& points)
      : scene_(scene), wave_(wave), wedge_(scene.wedges[wave.wedge]), points_(points) {}

  void fill(double from, double to, int halvings) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from) / std::sqrt(3.0);
    if (to - from < short_panel * scene_.shortest && halvings == 0) return put({middle, to - from}, at(middle));
    StripPath a = at(middle - half), b = at(middle + half);
    if (halvings < most_halvings && end_apart(a, b, scene_.shortest)) {
      fill(from, middle, halvings + 1);
      fill(middle, to, halvings + 1);
      return;
    }
    put({middle - half, 0.5 * (to - from)}, std::move(a));
    put({middle + half, 0.5 * (to - from)}, std::move(b));
  }

  std::vector<ArrivedPath> take() { return std::move(result_); }

 private:
  StripPath at(double arc_length) const {
    return strip_path(scene_, wave_, wedge_.start + (arc_length / wedge_.length()) * (wedge_.end - wedge_.start));
  }

  void put(const PanelPoint& point, StripPath path) {
    points_.push_back(point);
    result_.push_back({glm::dot(scene_.look.scattered - scene_.look.incident, path.start), std::move(path)});
  }

  const StripScene& scene_;
  const StripWave& wave_;
  const Wedge& wedge_;
  std::vector<PanelPoint>& points_;
  std::vector<ArrivedPath> result_;
};

// From points so close together that a panel would have one, a single strip is followed.
void add_shared(const StripScene& scene, const TreeWave& wave, std::span<const PanelPoint> points,
                std::vector<ArrivedPath>& paths) {
  const double reach = short_panel * scene.shortest / glm::length(wave.line.step);
  for (std::size_t i = 0, next = 0; i < points.size(); i = next) {
    for (next = i + 1; next < points.size() && points[next].arc_length - points[i].arc_length < reach;) ++next;
    const double arc_length = 0.5 * (points[i].arc_length + points[next - 1].arc_length);
    const dvec3 start = wave.line.at(arc_length);
    paths.push_back(
        {wave.path.at(arc_length),
         wave.wave.incidence.sin_cone < least_sine ? path_of(scene, wave.wave, start) : strip_path(scene, wave.wave, start),
         static_cast<std::uint32_t>(next - i)});
  }
}

}  // namespace

StripPath strip_path(const StripScene& scene, const StripWave& wave, const dvec3& point) {
  StripPath path = path_of(scene, wave, point);
  if (scene.curved->curved(wave.wedge, wave.face))
    follow_curved(scene, path);
  else
    follow_flat(scene, path);
  return path;
}

std::vector<StripWave> waves_from(const StripScene& scene, const WedgeSide& end, const dvec3& direction, int order) {
  StripWave arriving;
  arriving.strips_left = order;
  arriving.direction = in_face(scene, end, direction);
  const OutlineEdge edge = edge_of(scene, end);
  if (runs_along(edge, arriving.direction)) return {};
  const auto next = waves_beyond(scene.wedges, arriving, edge);
  return next ? std::vector<StripWave>(next->begin(), next->end()) : std::vector<StripWave>{};
}

void find_curved_waves(const StripScene& scene, const StripLayout& strips, CurvedWaves& paths) {
  if (scene.curved == nullptr) return;
  const std::size_t known = paths.size();
  paths.resize(strips.tree.waves().size());
  for (std::size_t w = known; w < paths.size(); ++w) {
    const TreeWave& wave = strips.tree.waves()[w];
    if (!strips.tree.runs_over_curved(wave.wave)) continue;
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const EdgePanels::PointRange& range = strips.panels.ranges()[b];
      add_shared(scene, wave, strips.panels.points().subspan(range.first, range.size()), paths[w]);
    }
  }
}

double work_of(const StripPath& path) {
  double sum = work::strip_point + work::surface_step * static_cast<double>(path.nodes.size());
  for (const StripPath& each : path.next) sum += work_of(each);
  return sum;
}

std::vector<ArrivedPath> first_curved_strips(const StripScene& scene, const StripWave& wave, std::span<const LitInterval> lit,
                                             std::vector<PanelPoint>& points) {
  FirstStrips strips(scene, wave, points);
  const double length = scene.wedges[wave.wedge].length();
  for (const LitInterval& piece : lit) {
    const double begin = piece.begin * length, end = piece.end * length;
    const int panels = std::max(1, static_cast<int>(std::ceil((end - begin) / (panel_length * scene.shortest) - 1e-9)));
    for (int i = 0; i < panels; ++i) strips.fill(begin + (end - begin) * i / panels, begin + (end - begin) * (i + 1) / panels, 0);
  }
  return strips.take();
}

}  // namespace raytube
