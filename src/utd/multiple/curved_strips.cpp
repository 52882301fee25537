#include "utd/multiple/curved_strips.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/work.h"
#include "utd/surface/edge_factors.h"
#include "utd/surface/strip_width.h"

namespace raytube {

namespace {

constexpr double root_step = 0.1;         // of the root of the wavelength, between points of a strip
constexpr double longest_step = 0.25;     // of the wavelength
constexpr double curvature_step = 0.125;  // of the wavelength, between points where the surface is asked for its curvature
constexpr double last_bend = 12.0;        // xi beyond which nothing is left
constexpr double widest = 30.0;           // of a strip's width at its edge
constexpr double panel_length = 0.33;     // of the wavelength, with two points
constexpr double short_panel = 1.0 / 6;   // with one point
constexpr double ends_apart = 0.5;        // of the wavelength
constexpr int most_halvings = 4;
constexpr double soft_tip = 1.0 / 30;  // electrical length below which strips pass less soft current on

class StripWalk {
 public:
  StripWalk(const StripScene& scene, StripPath& path, double wavelength, double longest)
      : scene_(scene),
        mesh_(scene.curved->target().tracer.mesh()),
        path_(path),
        wavelength_(wavelength),
        lowest_(std::cbrt(2 * pi / longest)) {}

  /// Fills in the strip's points; the wedge at its end.
  WedgeSide walk() {
    const CurvedFaces& faces = *scene_.curved;
    const CurvedTarget& target = faces.target();
    const WedgeFace& face = scene_.wedges[path_.wave.wedge].faces[path_.wave.face];
    const auto start = faces.at(path_.wave.wedge, path_.wave.face, path_.start);
    if (!start) return {};
    side_ = face.back ? -1.0 : 1.0;
    Geodesic geodesic(mesh_, target.surfaces, target.curvatures, target.edges, *start, path_.wave.direction);
    GeodesicPiece piece;
    while (geodesic.next(piece) && follow(target, piece)) {
    }
    if (path_.nodes.empty()) return {};
    if (path_.length > path_.nodes.back().root * path_.nodes.back().root) {
      move(target, last_, last_.to);
      if (!goes_on()) return {};
      put(target, last_, last_.to);
    }
    const int corner = geodesic.ended_at();
    return corner < 0 ? WedgeSide{} : faces.at(last_.from.triangle, corner, face.back);
  }

  const dvec3& direction() const { return direction_; }

 private:
  // Points of the strip stand in steps of its own, not at the sides of facets, which may be many; nor is the surface asked for
  // its curvature at each of them.
  bool follow(const CurvedTarget& target, const GeodesicPiece& piece) {
    const Triangle& t = mesh_.triangles[piece.from.triangle];
    const dvec2 way = piece.to - piece.from.l;
    const dvec3 &x = mesh_.vertices[t[0]], &y = mesh_.vertices[t[1]], &z = mesh_.vertices[t[2]];
    const double chord = glm::length(way.x * (y - x) + way.y * (z - x));
    if (chord <= 0.0) return true;
    if (path_.nodes.empty()) {
      move(target, piece, piece.from.l);
      put(target, piece, piece.from.l);
    }
    const double turn = curvature_ * chord, length = chord * (1.0 + turn * turn / 24.0), before = path_.length;
    const double step =
        std::min(root_step * std::sqrt(wavelength_), 0.5 * longest_step * wavelength_ / std::sqrt(before + length));
    for (double root = path_.nodes.back().root + step; root * root < before + length; root += step) {
      path_.length = std::max(root * root, path_.length);
      const dvec2 l = piece.from.l + ((path_.length - before) / length) * way;
      move(target, piece, l);
      if (!goes_on()) return false;
      put(target, piece, l);
    }
    path_.length = before + length;
    if (path_.length - known_ > curvature_step * wavelength_) move(target, piece, piece.to);
    last_ = piece;
    return goes_on();
  }

  bool goes_on() const { return std::abs(width_.width) < widest && lowest_ * bend_ < last_bend; }

  void move(const CurvedTarget& target, const GeodesicPiece& piece, const dvec2& l) {
    const SurfaceFrame frame = target.curvatures.at(piece.from.triangle, l);
    const double step = path_.length - known_;
    normal_ = side_ * frame.normal;
    direction_ = glm::normalize(piece.direction - glm::dot(piece.direction, normal_) * normal_);
    curvature_ = side_ * frame.curvature(direction_);
    if (step > 0.0) width_.step(frame.gaussian(), step);
    if (curvature_ > 0.0) bend_ += step * std::cbrt(0.5 * curvature_ * curvature_);
    known_ = path_.length;
  }

  void put(const CurvedTarget& target, const GeodesicPiece& piece, const dvec2& l) {
    const dvec3 aside = glm::cross(direction_, normal_);
    path_.end = target.surfaces.facet(piece.from.triangle).point(l);
    const double sine = path_.wave.incidence.sin_cone, cosine = path_.wave.incidence.cos_cone;
    StripNode node{std::sqrt(path_.length),
                   glm::dot(scene_.look.scattered, path_.end - path_.start) - path_.length,
                   bend_,
                   std::sqrt(std::abs(width_.width)),
                   width_.caustics,
                   {},
                   {}};
    const dvec3 across = sine * direction_ - cosine * aside, along = cosine * direction_ + sine * aside;
    for (int p = 0; p < 2; ++p) {
      node.across[p] = path_.wave.sign * glm::dot(scene_.look.receive[p], across) / (2 * pi * sine);
      node.along[p] = path_.wave.sign * glm::dot(scene_.look.receive[p], along) / (2 * pi * sine * sine);
    }
    path_.nodes.push_back(node);
  }

  const StripScene& scene_;
  const TriangleMesh& mesh_;
  StripPath& path_;
  double wavelength_, lowest_;
  double known_ = 0.0;  // how far the surface is
  double side_ = 1.0, curvature_ = 0.0, bend_ = 0.0;
  StripWidth width_{1.0};
  dvec3 direction_{0.0}, normal_{0.0};
  GeodesicPiece last_{};
};

// Strips that meet an edge at a smaller angle than that run along it: what starts there grows as its inverse, while the share of
// strips that do falls with it. Single points of a quadrature know the one and not the other.
constexpr double least_sine = 0.02;

bool runs_along(const OutlineEdge& edge, const dvec3& direction) { return -glm::dot(direction, edge.into_face) < least_sine; }

void start_next(const StripScene& scene, StripPath& path, const OutlineEdge& edge, const dvec3& direction, double wavelength,
                double longest) {
  if (runs_along(edge, direction)) return;
  StripWave arriving = path.wave;
  arriving.direction = direction;
  const auto next = waves_beyond(scene.wedges, arriving, edge);
  if (!next) return;
  for (const StripWave& wave : *next) path.next.push_back(strip_path(scene, wave, path.end, wavelength, longest));
}

StripPath path_of(const StripScene& scene, const StripWave& wave, const dvec3& point) {
  const double half_cosine = grazing_half_cosine(wave.across, wave.incidence, scene.look.scattered);
  return {wave,
          point,
          Strip(scene.wedges[wave.source].n, wave.incidence, half_cosine, scene.tier),
          face_projection(wave, scene.look),
          {},
          0.0,
          point,
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

void follow_flat(const StripScene& scene, StripPath& path, double wavelength, double longest) {
  const WedgeFace& face = scene.wedges[path.wave.wedge].faces[path.wave.face];
  const OutlineEdge* edge = strip_end(scene.outlines, face, path.wave, path.start);
  path.length = edge ? std::max(edge->distance(path.start, path.wave.direction), 0.0) : std::numeric_limits<double>::infinity();
  if (!edge) return;
  path.end = path.start + path.length * path.wave.direction;
  if (path.wave.goes_on()) start_next(scene, path, *edge, path.wave.direction, wavelength, longest);
}

void follow_curved(const StripScene& scene, StripPath& path, double wavelength, double longest) {
  StripWalk walk(scene, path, wavelength, longest);
  const WedgeSide at = walk.walk();
  if (at.wedge == no_index || !path.wave.goes_on()) return;
  start_next(scene, path, edge_of(scene, at), in_face(scene, at, walk.direction()), wavelength, longest);
}

// --- radiation ---

// The integral of x e^{jux} over [-1, 1] is 2j times this.
double odd_moment(double u) { return std::abs(u) < 1e-2 ? u * (1.0 / 3.0 - u * u / 30.0) : (std::sin(u) / u - std::cos(u)) / u; }

/// What a node radiates per unit of its root, for unit H and E along the edge, per receive polarisation; and what arrives there.
struct NodeCurrent {
  std::array<Complex, 2> magnetic{}, electric{};
  Complex end, soft_end;
};

NodeCurrent current_at(const StripNode& node, const StripWave& wave, double k, Complex hard, Complex axial, Complex soft) {
  const double sine = wave.incidence.sin_cone, root_rate = std::sqrt(2 * k) * sine, root = root_rate * node.root;
  const EdgeFactors factors = edge_factors(std::cbrt(k) * node.bend);
  const Complex area = std::polar(node.area, 0.5 * pi * node.caustics);
  const Complex across = area * factors.hard * hard * (root_rate * root);
  const Complex along = area * factors.hard * axial * (root_rate * wave.incidence.cos_cone);
  const Complex electric = area * factors.soft * soft * root_rate;
  NodeCurrent current;
  for (int p = 0; p < 2; ++p) {
    current.magnetic[p] = across * node.across[p] + along * node.along[p];
    current.electric[p] = electric * node.along[p];
  }
  current.end = Complex(0, 1) * area * factors.hard * hard;
  current.soft_end = root > 0.0 ? Complex(0, 1 / root) * area * factors.soft * soft : 0.0;
  return current;
}

/// The integrals over a strip, for unit H and E along its edge.
struct StripIntegral {
  std::array<Complex, 2> magnetic{}, electric{};
  Complex end, soft_end;

  void add_step(const NodeCurrent& a, const NodeCurrent& b, double step, double phase_a, double phase_b) {
    const double u = 0.5 * (phase_b - phase_a);
    const Complex phase = 0.5 * step * std::polar(1.0, 0.5 * (phase_a + phase_b));
    const Complex even = phase * sinc(u), odd = phase * Complex(0, odd_moment(u));
    for (int p = 0; p < 2; ++p) {
      magnetic[p] += even * (a.magnetic[p] + b.magnetic[p]) + odd * (b.magnetic[p] - a.magnetic[p]);
      electric[p] += even * (a.electric[p] + b.electric[p]) + odd * (b.electric[p] - a.electric[p]);
    }
  }

  void add_local(const StripPath& path, double reached) {
    const FringeKernels local = path.strip.local_part();
    for (int p = 0; p < 2; ++p) {
      magnetic[p] += reached * (local.hard * path.projection.across[p] +
                                path.wave.incidence.cos_cone * local.axial * path.projection.along[p]);
      electric[p] += reached * local.soft * path.projection.along[p];
    }
  }
};

StripIntegral over_curved(const StripPath& path, double k) {
  StripIntegral sum;
  const double rate = std::sqrt(2 * k) * path.wave.incidence.sin_cone;
  NodeCurrent before;
  for (std::size_t first = 0; first < path.nodes.size(); first += lanes) {
    const std::size_t count = std::min(lanes, path.nodes.size() - first);
    Reals root;
    for (std::size_t i = 0; i < lanes; ++i) root[i] = rate * path.nodes[first + std::min(i, count - 1)].root;
    const Strip::Currents currents = path.strip.currents(root);
    for (std::size_t i = 0; i < count; ++i) {
      const StripNode& node = path.nodes[first + i];
      const NodeCurrent here = current_at(node, path.wave, k, currents.hard[i], currents.axial[i], currents.soft[i]);
      if (first + i > 0) {
        const StripNode& last = path.nodes[first + i - 1];
        sum.add_step(before, here, node.root - last.root, k * last.path, k * node.path);
      }
      before = here;
    }
  }
  const double length = 0.5 * std::pow(rate * path.nodes.back().root, 2);
  sum.add_local(path, -std::expm1(-length));
  const Complex phase = std::polar(1.0, k * path.nodes.back().path);
  sum.end = phase * before.end;
  sum.soft_end = phase * before.soft_end * -std::expm1(-length / soft_tip);
  return sum;
}

StripIntegral over_flat(const StripPath& path, double k) {
  KernelBatch batch;
  const double length = k * path.length * path.wave.incidence.sin_cone * path.wave.incidence.sin_cone;
  path.strip.at(std::span(&length, 1), batch);
  const StripKernels kernels = batch[0];
  StripIntegral sum;
  for (int p = 0; p < 2; ++p) {
    sum.magnetic[p] = kernels.current.hard * path.projection.across[p] +
                      path.wave.incidence.cos_cone * kernels.current.axial * path.projection.along[p];
    sum.electric[p] = kernels.current.soft * path.projection.along[p];
  }
  sum.end = kernels.end;
  sum.soft_end = kernels.soft_end;
  return sum;
}

}  // namespace

StripPath strip_path(const StripScene& scene, const StripWave& wave, const dvec3& point, double wavelength, double longest) {
  StripPath path = path_of(scene, wave, point);
  if (scene.curved->curved(wave.wedge, wave.face))
    follow_curved(scene, path, wavelength, longest);
  else
    follow_flat(scene, path, wavelength, longest);
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

void find_curved_waves(const StripScene& scene, const StripLayout& strips, double wavelength, double longest,
                       CurvedWaves& paths) {
  paths.assign(strips.tree.waves().size(), {});
  for (std::size_t w = 0; w < paths.size(); ++w) {
    const TreeWave& wave = strips.tree.waves()[w];
    if (!strips.tree.runs_over_curved(wave.wave)) continue;
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const EdgePanels::PointRange& range = strips.panels.ranges()[b];
      for (const PanelPoint& point : strips.panels.points().subspan(range.first, range.size()))
        paths[w].push_back(wave.wave.incidence.sin_cone < least_sine
                               ? path_of(scene, wave.wave, wave.line.at(point.arc_length))
                               : strip_path(scene, wave.wave, wave.line.at(point.arc_length), wavelength, longest));
    }
  }
}

void radiate(const StripPath& path, double wavenumber, const StripStart& start, ScatteringMatrix& own,
             ScatteringMatrix& further) {
  if (path.length <= 0.0) return;
  const StripIntegral sum = path.nodes.empty() ? over_flat(path, wavenumber) : over_curved(path, wavenumber);
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit)
      own.at(receive, transmit) +=
          sum.magnetic[receive] * start.magnetic[transmit] + sum.electric[receive] * start.electric[transmit];
  if (path.next.empty()) return;
  StripStart next{};
  for (int transmit = 0; transmit < 2; ++transmit)
    next.magnetic[transmit] = start.magnetic[transmit] * sum.end + start.lying[transmit] * sum.soft_end;
  for (const StripPath& each : path.next) radiate(each, wavenumber, next, further, further);
}

double work_of(const StripPath& path) {
  double sum = work::strip_point + work::surface_step * static_cast<double>(path.nodes.size());
  for (const StripPath& each : path.next) sum += work_of(each);
  return sum;
}

namespace {

bool end_apart(const StripPath& a, const StripPath& b, double wavelength) {
  return glm::distance(a.end, b.end) > ends_apart * wavelength + glm::distance(a.start, b.start);
}

class EdgeOfPaths {
 public:
  EdgeOfPaths(const StripScene& scene, const StripWave& wave, double wavelength, double longest)
      : scene_(scene), wave_(wave), wedge_(scene.wedges[wave.wedge]), wavelength_(wavelength), longest_(longest) {}

  void fill(double from, double to, int halvings) {
    if (to - from < short_panel * wavelength_ && halvings == 0) {
      result_.push_back({to - from, at(0.5 * (from + to))});
      return;
    }
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from) / std::sqrt(3.0);
    StripPath a = at(middle - half), b = at(middle + half);
    if (halvings < most_halvings && end_apart(a, b, wavelength_)) {
      fill(from, middle, halvings + 1);
      fill(middle, to, halvings + 1);
      return;
    }
    result_.push_back({0.5 * (to - from), std::move(a)});
    result_.push_back({0.5 * (to - from), std::move(b)});
  }

  std::vector<WeightedPath> take() { return std::move(result_); }

 private:
  StripPath at(double arc_length) const {
    const dvec3 point = wedge_.start + (arc_length / wedge_.length()) * (wedge_.end - wedge_.start);
    return strip_path(scene_, wave_, point, wavelength_, longest_);
  }

  const StripScene& scene_;
  const StripWave& wave_;
  const Wedge& wedge_;
  double wavelength_, longest_;
  std::vector<WeightedPath> result_;
};

}  // namespace

std::vector<WeightedPath> strip_paths(const StripScene& scene, const StripWave& wave, std::span<const LitInterval> lit,
                                      double wavelength, double longest) {
  EdgeOfPaths edge(scene, wave, wavelength, longest);
  const double length = scene.wedges[wave.wedge].length();
  for (const LitInterval& piece : lit) {
    const double begin = piece.begin * length, end = piece.end * length;
    const int panels = std::max(1, static_cast<int>(std::ceil((end - begin) / (panel_length * wavelength) - 1e-9)));
    for (int i = 0; i < panels; ++i) edge.fill(begin + (end - begin) * i / panels, begin + (end - begin) * (i + 1) / panels, 0);
  }
  return edge.take();
}

}  // namespace raytube
