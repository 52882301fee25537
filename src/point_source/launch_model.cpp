#include "point_source/launch_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/random.h"

namespace raytube {

namespace {

constexpr double full_sphere = 4.0 * pi;

std::uint32_t at_least_one(double count) { return count > 1.0 ? static_cast<std::uint32_t>(std::lround(count)) : 1; }

// Nearly square cells, `asked` of them on `area`.
void divide(LaunchFace& face, double asked, double area) {
  const double per_metre = std::sqrt(asked / area);
  face.columns = at_least_one(per_metre * glm::length(face.side_u));
  face.rows = at_least_one(per_metre * glm::length(face.side_v));
}

std::vector<LaunchFace> wall_grid(const Box& box, double asked) {
  const std::array<LaunchFace, 6> walls = walls_of(box);
  double area = 0.0;
  for (const LaunchFace& wall : walls) area += wall.area();
  std::vector<LaunchFace> faces(walls.begin(), walls.end());
  for (LaunchFace& face : faces) divide(face, asked, area);
  return faces;
}

dvec3 inward(int wall) {
  dvec3 normal(0.0);
  normal[wall / 2] = wall % 2 == 0 ? 1.0 : -1.0;
  return normal;
}

// A little inside the box, so that a wall of the scene that closes it there is not what the rays meet first.
std::vector<LaunchFace> one_wall(const Box& box, int wall, double asked) {
  LaunchFace face = walls_of(box)[wall];
  if (!(face.area() > 0.0))
    throw InputError(
        "the enclosing box is flat, so the wall that the model \"plane-wave\" starts from has no area; give scene.box_m");
  face.corner += 1e-5 * box.diagonal() * inward(wall);
  divide(face, asked, face.area());
  return {face};
}

// Sides halved again and again, so columns is a power of two: that with the number of rays nearest to what is asked.
std::vector<LaunchFace> octahedron(const dvec3& centre, double asked) {
  const auto rays = [](std::uint32_t columns) { return 8.0 * columns * columns; };
  std::uint32_t columns = 1;
  while (std::abs(rays(2 * columns) - asked) < std::abs(rays(columns) - asked)) columns *= 2;
  std::vector<LaunchFace> faces;
  for (const double x : {1.0, -1.0})
    for (const double y : {1.0, -1.0})
      for (const double z : {1.0, -1.0})
        faces.push_back({centre + dvec3(0, 0, z), dvec3(x, 0, -z), dvec3(0, y, -z), true, columns, columns, no_index});
  return faces;
}

std::vector<LaunchFace> triangles_of(const TriangleMesh& mesh, double asked) {
  const std::uint32_t columns = at_least_one(std::sqrt(asked / static_cast<double>(mesh.triangles.size())));
  std::vector<LaunchFace> faces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const dvec3 &a = mesh.vertices[mesh.triangles[t][0]], &b = mesh.vertices[mesh.triangles[t][1]];
    faces.push_back({a, b - a, mesh.vertices[mesh.triangles[t][2]] - a, true, columns, columns, t});
  }
  return faces;
}

void require_inside(const LaunchSite& site, LaunchModel model) {
  const dvec3 margin(site.tolerance);
  if (glm::all(glm::greaterThan(site.source - site.box.low, margin)) &&
      glm::all(glm::greaterThan(site.box.high - site.source, margin)))
    return;
  throw InputError("source.point_m lies on the enclosing box or outside it, and the model \"" +
                   std::string(launch_model_name(model)) +
                   "\" sends rays through its walls; move it inside, or give a larger scene.box_m");
}

// The largest whole number whose square is at most n.
std::uint64_t whole_root(std::uint64_t n) {
  auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(n)));
  while (root * root > n) --root;
  while ((root + 1) * (root + 1) <= n) ++root;
  return root;
}

// Strips parallel to the side opposite `corner` hold 1, 3, 5 ... small triangles, upright and inverted in turn.
std::array<dvec3, 3> small_triangle(const LaunchFace& face, std::uint64_t index) {
  const std::uint64_t strip = whole_root(index), within = index - strip * strip, column = within / 2;
  const auto point = [&](std::uint64_t row, std::uint64_t along) {
    const double m = face.columns;
    return face.corner + static_cast<double>(row - along) / m * face.side_u + static_cast<double>(along) / m * face.side_v;
  };
  if (within % 2 == 0) return {point(strip, column), point(strip + 1, column), point(strip + 1, column + 1)};
  return {point(strip, column), point(strip, column + 1), point(strip + 1, column + 1)};
}

std::array<dvec3, 4> small_rectangle(const LaunchFace& face, std::uint64_t index) {
  const dvec3 u = face.side_u / static_cast<double>(face.columns), v = face.side_v / static_cast<double>(face.rows);
  const std::uint64_t row = index / face.columns, column = index % face.columns;
  const dvec3 corner = face.corner + static_cast<double>(column) * u + static_cast<double>(row) * v;
  return {corner, corner + u, corner + u + v, corner + v};
}

struct AngleCell {
  double azimuth, low_elevation, high_elevation, step;
};

AngleCell angle_cell(std::uint64_t index, std::uint32_t elevation_steps) {
  const std::uint64_t azimuth_steps = std::uint64_t{2} * elevation_steps;
  const std::uint64_t row = index / azimuth_steps, column = index % azimuth_steps;
  const double step = pi / elevation_steps, low = static_cast<double>(row) * step - pi / 2;
  return {(static_cast<double>(column) + 0.5 + beside_u) * step, low, low + step, step};
}

}  // namespace

SpatialPolygon LaunchFace::outline() const {
  if (is_triangle) return {corner, corner + side_u, corner + side_v};
  return {corner, corner + side_u, corner + side_u + side_v, corner + side_v};
}

std::array<LaunchFace, 6> walls_of(const Box& box) {
  std::array<LaunchFace, 6> walls;
  const dvec3 size = box.high - box.low;
  for (int wall = 0; wall < 6; ++wall) {
    const int axis = wall / 2, first = axis == 0 ? 1 : 0, second = axis == 2 ? 1 : 2;
    LaunchFace& face = walls[wall];
    face.corner = box.low;
    if (wall % 2 == 1) face.corner[axis] = box.high[axis];
    face.side_u = face.side_v = dvec3(0.0);
    face.side_u[first] = size[first];
    face.side_v[second] = size[second];
  }
  return walls;
}

Launch::Launch(LaunchModel model, const LaunchSite& site, std::uint64_t asked, std::uint64_t seed)
    : model_(model), eye_{site.source, {}}, seed_(seed) {
  const auto wanted = static_cast<double>(asked);
  switch (model) {
    case LaunchModel::random:
      require_inside(site, model);
      use(wall_grid(site.box, 1.0));
      rays_ = asked;
      break;
    case LaunchModel::angles:
      elevation_steps_ = at_least_one(std::sqrt(wanted / 2.0));
      rays_ = 2 * std::uint64_t{elevation_steps_} * elevation_steps_;
      break;
    case LaunchModel::octahedron:
      use(octahedron(site.source, wanted));
      break;
    case LaunchModel::box_grid:
      require_inside(site, model);
      use(wall_grid(site.box, wanted));
      break;
    case LaunchModel::plane_wave:
      use(one_wall(site.box, site.wall, wanted));
      eye_ = {faces_[0].corner, inward(site.wall)};
      break;
    case LaunchModel::geometry:
      use(triangles_of(*site.mesh, wanted));
      break;
  }
}

void Launch::use(std::vector<LaunchFace> faces) {
  faces_ = std::move(faces);
  double before = 0.0;
  for (const LaunchFace& face : faces_) {
    first_ray_.push_back(rays_);
    area_before_.push_back(before);
    rays_ += face.cells();
    before += face.area();
  }
}

double Launch::area() const { return area_before_.back() + faces_.back().area(); }

// By area: the first random number chooses the face, and what is left of it the position along u.
dvec3 Launch::random_point(std::uint64_t index, std::uint32_t& face) const {
  const dvec2 drawn = raytube::random_point(seed_, 0, index);
  const double first = drawn.x, second = drawn.y;
  const double at = first * area();
  face = static_cast<std::uint32_t>(std::upper_bound(area_before_.begin(), area_before_.end(), at) - area_before_.begin() - 1);
  const LaunchFace& wall = faces_[face];
  const double along = std::min((at - area_before_[face]) / wall.area(), 1.0);
  return wall.corner + along * wall.side_u + second * wall.side_v;
}

Launch::Cell Launch::cell(std::uint64_t index) const {
  const auto after = std::upper_bound(first_ray_.begin(), first_ray_.end(), index);
  const auto number = static_cast<std::uint32_t>(after - first_ray_.begin() - 1);
  const LaunchFace& face = faces_[number];
  const std::uint64_t within = index - first_ray_[number];
  if (face.is_triangle) {
    const auto [a, b, c] = small_triangle(face, within);
    return {number, {a, b, c, c}, (a + b + c) / 3.0 + beside_u * (b - a) + beside_v * (c - a)};
  }
  const std::array<dvec3, 4> corners = small_rectangle(face, within);
  const dvec3 middle = 0.5 * (corners[0] + corners[2]);
  return {number, corners, middle + beside_u * (corners[1] - corners[0]) + beside_v * (corners[3] - corners[0])};
}

dvec3 Launch::through(std::uint64_t index, std::uint32_t& face) const {
  if (model_ == LaunchModel::random) return random_point(index, face);
  if (model_ != LaunchModel::angles) {
    const Cell here = cell(index);
    face = here.face;
    return here.through;
  }
  const AngleCell a = angle_cell(index, elevation_steps_);
  const double elevation = 0.5 * (a.low_elevation + a.high_elevation) + beside_v * a.step, out = std::cos(elevation);
  return eye_.position + dvec3(out * std::cos(a.azimuth), out * std::sin(a.azimuth), std::sin(elevation));
}

LaunchedRay Launch::ray(std::uint64_t index) const {
  LaunchedRay launched;
  launched.index = index;
  launched.through = through(index, launched.face);
  if (!faces_.empty()) launched.aimed = faces_[launched.face].aimed;
  launched.ray = eye_.direction ? Ray{launched.through, *eye_.direction}
                                : Ray{eye_.position, glm::normalize(launched.through - eye_.position)};
  return launched;
}

// dOmega = height dA / distance^3, for a share 1 / rays of the area.
double Launch::random_weight(const LaunchedRay& launched) const {
  const LaunchFace& face = faces_[launched.face];
  const dvec3 to = launched.through - eye_.position;
  const double distance = glm::length(to);
  const double height = std::abs(glm::dot(glm::cross(face.side_u, face.side_v), to)) / face.area();
  return height / (distance * distance * distance) * area() / (full_sphere * static_cast<double>(rays_));
}

double Launch::weight(const LaunchedRay& launched) const {
  if (eye_.direction) return not_known;
  if (model_ == LaunchModel::random) return random_weight(launched);
  if (model_ == LaunchModel::angles) {
    const AngleCell a = angle_cell(launched.index, elevation_steps_);
    return a.step * (std::sin(a.high_elevation) - std::sin(a.low_elevation)) / full_sphere;
  }
  const Cell here = cell(launched.index);
  const dvec3 a = here.corners[0] - eye_.position, b = here.corners[1] - eye_.position, c = here.corners[2] - eye_.position;
  const double half = faces_[here.face].is_triangle ? 0.0 : solid_angle(a, c, here.corners[3] - eye_.position);
  return (solid_angle(a, b, c) + half) / full_sphere;
}

}  // namespace raytube
