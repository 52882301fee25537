#include "point_source/launch_limit.h"

#include <algorithm>
#include <cmath>

#include "math/gauss.h"
#include "math/special/elementary.h"

namespace raytube {

namespace {

constexpr double full = 4.0 * pi;

// Cells of a face that the segment can cross: one, and one more for every line of the grid on its way.
double cells_crossed(const LaunchFace& face, const dvec3& from, const dvec3& to) {
  const dvec3 normal = glm::cross(face.side_u, face.side_v), way = to - from;
  const double square = glm::dot(normal, normal);
  const double along_u = glm::dot(glm::cross(way, face.side_v), normal) / square;
  const double along_v = glm::dot(glm::cross(face.side_u, way), normal) / square;
  const auto lines = [](double cells) { return std::ceil(std::abs(cells)); };
  if (!face.is_triangle) return 1.0 + lines(along_u * face.columns) + lines(along_v * face.rows);
  return 1.0 + lines(along_u * face.columns) + lines(along_v * face.columns) + lines((along_u + along_v) * face.columns);
}

double distance_to_segment(const dvec3& point, const dvec3& a, const dvec3& b) {
  const dvec3 along = b - a;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? std::clamp(glm::dot(point - a, along) / square, 0.0, 1.0) : 0.0;
  return glm::length(point - a - t * along);
}

// The largest share of the sphere that a cell at this segment can have: dOmega / dA = height / distance^3, the nearest point of
// the cell one diagonal closer than the segment.
double largest_share(const LaunchFace& face, const dvec3& eye, const dvec3& a, const dvec3& b) {
  const double cells = static_cast<double>(face.cells());
  const dvec3 u = face.side_u / static_cast<double>(face.columns);
  const dvec3 v = face.side_v / static_cast<double>(face.is_triangle ? face.columns : face.rows);
  const dvec3 normal = glm::normalize(glm::cross(face.side_u, face.side_v));
  const double height = std::abs(glm::dot(normal, face.corner - eye));
  if (height == 0.0) return 0.0;
  const double nearest = std::max(distance_to_segment(eye, a, b) - glm::length(u) - glm::length(v), height);
  return std::min(0.5, height / (nearest * nearest * nearest) * face.area() / cells / full);
}

// The integral of the distance from the pole over azimuth, counted from the highest point of a great circle.
double gap_rule(double tangent, double begin, double end) {
  double sum = 0.0;
  for (const GaussPoint& point : gauss_rule(8))
    sum += point.weight * (pi / 2 - arc_tangent(tangent * std::cos(begin + (end - begin) * point.node)));
  return (end - begin) * sum;
}

double gap_integral(double tangent, double begin, double end) {
  const double middle = 0.5 * (begin + end), whole = gap_rule(tangent, begin, end);
  const double halves = gap_rule(tangent, begin, middle) + gap_rule(tangent, middle, end);
  if (std::abs(whole - halves) < 1e-13 || end - begin < 1e-9) return halves;
  return gap_integral(tangent, begin, middle) + gap_integral(tangent, middle, end);
}

// An edge above the horizon as an arc: azimuths from its highest point, increasing, and the sense it is run along.
struct Arc {
  double tangent, begin, end, sense;
};

// Nothing for an arc through the pole, which covers no azimuth where the distance from the pole is not zero.
std::optional<Arc> arc(const dvec3& a, const dvec3& b) {
  dvec3 pole = glm::cross(a, b);
  const double sense = pole.z < 0.0 ? -1.0 : 1.0;
  pole *= sense;
  const double across = std::hypot(pole.x, pole.y);
  if (pole.z <= 1e-15 * glm::length(pole)) return std::nullopt;
  const dvec2 highest = across > 0.0 ? dvec2(-pole.x, -pole.y) / across : glm::normalize(dvec2(a));
  const auto azimuth = [&](const dvec3& d) {
    return std::atan2(highest.x * d.y - highest.y * d.x, highest.x * d.x + highest.y * d.y);
  };
  double begin = azimuth(sense > 0.0 ? a : b), end = azimuth(sense > 0.0 ? b : a);
  if (end < begin) end += 2.0 * pi;
  return Arc{across / pole.z, begin, end, sense};
}

struct Crossed {
  double cells = 0.0, share = 0.0;
};

double elevation(const dvec3& direction) { return std::atan2(direction.z, std::hypot(direction.x, direction.y)); }

// Cells of equal steps that the arc between two directions above the horizon can cross, and the most of the sphere they can have:
// they get smaller towards the pole. An arc without a highest point on it climbs only; one over the pole covers two columns.
Crossed cells_crossed(const dvec3& a, const dvec3& b, std::uint32_t steps) {
  const double step = pi / steps, first = elevation(a), last = elevation(b);
  const auto edge = arc(a, b);
  const bool over_pole = !edge && a.x * b.x + a.y * b.y < 0.0;
  double top = std::max(first, last), columns = 0.0;
  if (over_pole) top = pi / 2;
  if (edge && edge->begin < 0.0 && edge->end > 0.0) top = arc_tangent(edge->tangent);
  if (edge) columns = std::ceil((edge->end - edge->begin) / step);
  const double cells = (over_pole ? 3.0 : 2.0) + columns + std::ceil((2.0 * top - first - last) / step);
  const double lowest = std::clamp(std::min(first, last) - step, 0.0, pi / 2);
  return {cells, cells * step * step * std::cos(lowest) / full};
}

// Above and below the horizon, where there is anything; both as if above.
std::array<SpatialPolygon, 2> above_and_below(const SpatialPolygon& directions, double tolerance) {
  std::array<SpatialPolygon, 2> halves;
  cut(directions, {dvec3(0, 0, 1), 0.0}, tolerance, halves[0], halves[1]);
  for (dvec3& corner : halves[1]) corner.z = -corner.z;
  return halves;
}

Crossed angle_cells_crossed(const Segment& border, const dvec3& from, std::uint32_t steps) {
  Crossed crossed;
  for (const SpatialPolygon& half : above_and_below({border.from - from, border.to - from}, 0.0)) {
    if (half.size() < 2) continue;
    const Crossed here = cells_crossed(half[0], half[1], steps);
    crossed = {crossed.cells + here.cells, crossed.share + here.share};
  }
  return crossed;
}

// Of the part of a polygon above the horizon.
double upper_area(const SpatialPolygon& directions) {
  double sum = 0.0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const auto edge = arc(directions[i], directions[i + 1 < directions.size() ? i + 1 : 0]);
    if (edge) sum += edge->sense * gap_integral(edge->tangent, edge->begin, edge->end);
  }
  return std::abs(sum);
}

// The part of a border that lies inside the cone through a face, as the eye projects it on that face.
std::optional<Segment> projected(const Eye& eye, const LaunchFace& face, const Shadow& cone, const Segment& border) {
  double begin = 0.0, end = 1.0;
  for (const HalfSpace& side : cone.sides) {
    const double first = side(border.from), last = side(border.to);
    if (first <= 0.0 && last <= 0.0) return std::nullopt;
    const double zero = first / (first - last);
    if (first < 0.0) begin = std::max(begin, zero);
    if (last < 0.0) end = std::min(end, zero);
  }
  if (begin >= end) return std::nullopt;
  const dvec3 normal = glm::cross(face.side_u, face.side_v);
  const auto on_face = [&](double t) {
    const dvec3 point = border.from + t * (border.to - border.from), ray = eye.ray_at(point);
    return point + glm::dot(normal, face.corner - point) / glm::dot(normal, ray) * ray;
  };
  return Segment{on_face(begin), on_face(end)};
}

// A face edge-on to the eye has no cone: there the outline of what is lit stands for the borders.
void add_bounds(const Launch& launch, const LaunchFace& face, const VisiblePiece& piece, const SpatialPolygon& lit,
                double tolerance, LaunchLimit& to) {
  const auto cone = shadow(launch.eye(), face.outline(), tolerance);
  if (!cone) {
    for (std::size_t i = 0; i < lit.size(); ++i)
      to.bound += cells_crossed(face, lit[i], lit[i + 1 < lit.size() ? i + 1 : 0]) / static_cast<double>(launch.rays());
    return;
  }
  const bool own = face.aimed == no_index || face.aimed == piece.triangle;
  for (const Segment& border : piece.border) {
    const auto line = projected(launch.eye(), face, *cone, border);
    if (!line) continue;
    const double crossed = cells_crossed(face, line->from, line->to);
    to.bound += crossed / static_cast<double>(launch.rays());
    if (own) to.estimate_bound += crossed * largest_share(face, launch.eye().position, line->from, line->to);
  }
}

// The share of a model's measure that a face has: of random points its area, of a grid its rays.
std::vector<double> face_shares(const Launch& launch) {
  const bool by_area = launch.model() == LaunchModel::random;
  std::vector<double> shares;
  double sum = 0.0;
  for (const LaunchFace& face : launch.faces()) {
    shares.push_back(by_area ? face.area() : static_cast<double>(face.cells()));
    sum += shares.back();
  }
  for (double& share : shares) share /= sum;
  return shares;
}

void add_faces(const Launch& launch, const VisiblePiece& piece, std::span<const double> shares, double tolerance,
               LaunchLimit& to) {
  const auto cone = shadow(launch.eye(), piece.outline, tolerance);
  if (!cone) return;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const LaunchFace& face = launch.faces()[i];
    const SpatialPolygon lit = clipped(face.outline(), *cone, tolerance);
    if (lit.empty()) continue;
    to.share += shares[i] * area(lit) / face.area();
    if (launch.model() != LaunchModel::random) add_bounds(launch, face, piece, lit, tolerance, to);
  }
}

void add_angles(const Launch& launch, const VisiblePiece& piece, double tolerance, LaunchLimit& to) {
  const dvec3& from = launch.eye().position;
  to.share += angle_area(piece.outline, from, tolerance) / (2.0 * pi * pi);
  for (const Segment& border : piece.border) {
    const auto [crossed, share] = angle_cells_crossed(border, from, launch.elevation_steps());
    to.bound += crossed / static_cast<double>(launch.rays());
    to.estimate_bound += share;
  }
}

// Four standard deviations of a binomial share.
double four_sigma(double share, double rays) { return 4.0 * std::sqrt(std::max(0.0, share * (1.0 - share)) / rays); }

}  // namespace

double angle_area(const SpatialPolygon& polygon, const dvec3& from, double tolerance) {
  SpatialPolygon directions;
  for (const dvec3& corner : polygon) directions.push_back(corner - from);
  const auto [above, below] = above_and_below(directions, tolerance);
  return upper_area(above) + upper_area(below);
}

std::vector<LaunchLimit> launch_limits(const Launch& launch, std::span<const VisiblePiece> visible,
                                       std::span<const std::uint32_t> triangle_part, std::size_t parts, double tolerance) {
  std::vector<LaunchLimit> limits(parts);
  const std::vector<double> shares = face_shares(launch);
  for (const VisiblePiece& piece : visible) {
    LaunchLimit& limit = limits[triangle_part[piece.triangle]];
    if (launch.model() == LaunchModel::angles)
      add_angles(launch, piece, tolerance, limit);
    else
      add_faces(launch, piece, shares, tolerance, limit);
  }
  for (LaunchLimit& limit : limits) {
    if (launch.model() == LaunchModel::random) limit.bound = four_sigma(limit.share, static_cast<double>(launch.rays()));
    if (launch.eye().direction || launch.model() == LaunchModel::random) limit.estimate_bound = not_known;
    limit.bound = std::min(limit.bound, 1.0);
    limit.estimate_bound = std::min(limit.estimate_bound, 1.0);
  }
  return limits;
}

}  // namespace raytube
