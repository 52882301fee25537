#include "output/report/scene_json.h"

#include <algorithm>
#include <limits>

#include "output/report/blocks.h"
#include "output/report/packed.h"
#include "output/report/shown_mesh.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::size_t most_edges = 5'000;

std::size_t most_triangles(std::size_t looks) { return looks > 1 ? 40'000 : 60'000; }

JsonValue vector_json(const dvec3& v) { return std::vector<double>{v.x, v.y, v.z}; }

void append(std::vector<double>& numbers, const dvec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); }

std::string packed_points(const std::vector<dvec3>& points) {
  std::vector<double> numbers;
  for (const dvec3& point : points) append(numbers, point);
  return packed_floats(numbers);
}

std::string packed_corners(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return packed_indices(corners);
}

// Of each triangle shown the strongest that it stands for.
JsonValue triangle_levels(const LookImage& image, const ShownMesh& mesh) {
  BlockLevels levels(Blocks(1, 1), Blocks(mesh.triangles.size(), mesh.triangles.size()));
  for (std::size_t i = 0; i < image.triangles.size(); ++i) levels.add(0, mesh.shown_as[i], image.triangles[i]);
  return levels.json();
}

JsonValue edges_json(std::vector<ImageEdge> edges) {
  std::ranges::stable_sort(edges, std::ranges::greater{}, [](const ImageEdge& edge) { return largest_amplitude(edge.s); });
  if (edges.size() > most_edges) edges.resize(most_edges);
  std::vector<dvec3> ends;
  BlockLevels levels(Blocks(1, 1), Blocks(edges.size(), edges.size()));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    ends.insert(ends.end(), {edges[i].begin, edges[i].end});
    levels.add(0, i, edges[i].s);
  }
  return {{"ends", packed_points(ends)}, {"sigma", levels.json()}};
}

JsonValue cells_json(const LookImage& image) {
  const ImageLattice& lattice = image.lattice;
  if (image.cells.empty()) return {};
  const dvec2 corner = lattice.corner + lattice.shift_of_perspective();  // laid over the target without perspective
  BlockLevels levels(Blocks(lattice.rows, lattice.rows), Blocks(lattice.columns, lattice.columns));
  for (std::size_t i = 0; i < image.cells.size(); ++i) levels.add(i / lattice.columns, i % lattice.columns, image.cells[i]);
  return {{"u", vector_json(lattice.u_hat)},
          {"v", vector_json(lattice.v_hat)},
          {"corner", std::vector<double>{corner.x, corner.y}},
          {"cell", std::vector<double>{lattice.cell.x, lattice.cell.y}},
          {"columns", lattice.columns},
          {"rows", lattice.rows},
          {"sigma", levels.json()}};
}

// Segments with the number of surfaces met before each.
JsonValue tubes_json(const TubePaths& tubes) {
  std::vector<dvec3> ends;
  std::vector<std::uint32_t> bounces;
  for (const TubePath& path : tubes.paths)
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      ends.insert(ends.end(), {path.points[i - 1].position, path.points[i].position});
      bounces.push_back(static_cast<std::uint32_t>(path.points[i - 1].bounce));
    }
  return {{"ends", packed_points(ends)}, {"bounces", packed_indices(bounces)}, {"paths", tubes.met_target()}};
}

JsonValue look_json(const SceneLook& look, const ShownMesh& mesh) {
  return {{"look", look.image.look},
          {"ghz", look.image.frequency / 1e9},
          {"sigma", triangle_levels(look.image, mesh)},
          {"edges", edges_json(look.image.edges)},
          {"cells", cells_json(look.image)},
          {"tubes", tubes_json(look.tubes)}};
}

}  // namespace

JsonValue scene_json(const ReportScene& scene) {
  if (scene.triangles.empty()) return {};
  const ShownMesh mesh = shown_mesh(scene.vertices, scene.triangles, most_triangles(scene.looks.size()));
  std::vector<dvec3> lines;
  for (const auto& line : scene.lines) lines.insert(lines.end(), line.begin(), line.end());
  JsonValue looks{std::vector<JsonValue>{}};
  for (const SceneLook& look : scene.looks) looks.append(look_json(look, mesh));
  return {{"vertices", packed_points(mesh.vertices)},
          {"triangles", packed_corners(mesh.triangles)},
          {"traced", scene.triangles.size()},
          {"shown", mesh.triangles.size()},
          {"lines", packed_points(lines)},
          {"looks", looks}};
}

}  // namespace raytube
