// Time of the edge pass beside that of the tubes, in one run: a field of boxes, 0.3 m, 94 GHz, 10 tubes per wavelength.
//   edge_pass [--boxes N] [--looks N] [--repeat N] [--threads N]
// Prints the medians of the repeats (all orders taken in turn) as ratios to the tubes' time. No timing is asserted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "solve/solve.h"
#include "timing.h"

namespace {

using namespace raytube;
using bench::median;

constexpr double side = 0.3;       // [m] of the whole field
constexpr std::uint32_t cuts = 3;  // per side of a box's face: 2 x 9 triangles on each of six faces

void add_face(PolygonSoup& soup, const dvec3& corner, const dvec3& u, const dvec3& v) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (std::uint32_t i = 0; i <= cuts; ++i)
    for (std::uint32_t j = 0; j <= cuts; ++j) soup.points.push_back(corner + (u * double(i) + v * double(j)) / double(cuts));
  for (std::uint32_t i = 0; i < cuts; ++i)
    for (std::uint32_t j = 0; j < cuts; ++j) {
      const std::uint32_t a = first + i * (cuts + 1) + j;
      soup.polygons.push_back({a, a + cuts + 1, a + cuts + 2, a + 1});
    }
}

void add_box(PolygonSoup& soup, const dvec3& middle, double width, double height, double turn) {
  const dvec3 x = width * dvec3(std::cos(turn), std::sin(turn), 0), y = width * dvec3(-std::sin(turn), std::cos(turn), 0),
              z(0, 0, height), low = middle - (x + y) / 2.0, high = low + x + y + z;
  add_face(soup, low, y, x);
  add_face(soup, low, x, z);
  add_face(soup, low, z, y);
  add_face(soup, high, -x, -y);
  add_face(soup, high, -z, -x);
  add_face(soup, high, -y, -z);
}

// Boxes of different heights, each turned by another angle, standing apart on a square.
PolygonSoup box_field(std::uint32_t boxes) {
  PolygonSoup soup;
  const double pitch = side / boxes;
  for (std::uint32_t i = 0; i < boxes; ++i)
    for (std::uint32_t j = 0; j < boxes; ++j) {
      const std::uint32_t number = i * boxes + j;
      add_box(soup, dvec3((i + 0.5) * pitch - side / 2, (j + 0.5) * pitch - side / 2, 0), 0.6 * pitch,
              pitch * (0.5 + number * 7 % 11 / 11.0), number * 0.37);
    }
  return soup;
}

double solve_time(const Target& target, const Sweep& sweep, EdgeMethod method, int order, int threads) {
  SolveOptions options;
  options.edges.method = method;
  options.edges.order = order;
  options.edges.interaction = false;
  options.threads = threads;
  return solve(target, sweep, options).statistics.solve_s;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t boxes = 29;
  int looks = 361, repeat = 3, threads = 2;
  CLI::App app{"Time of the edge pass beside that of the tubes"};
  app.add_option("--boxes", boxes, "boxes along each side");
  app.add_option("--looks", looks, "looks on a circle 30 degrees above the ground");
  app.add_option("--repeat", repeat, "runs of which the median is taken");
  app.add_option("--threads", threads, "threads");
  CLI11_PARSE(app, argc, argv);

  const LoadedMesh loaded = build_mesh(box_field(boxes), 1.0);
  const Target target(loaded.mesh);
  Sweep sweep{{94e9}, {}, false};
  for (int i = 0; i < looks; ++i) sweep.looks.push_back({{pi / 3, i * pi / 360}, {pi / 3, i * pi / 360}});
  std::vector<double> tubes, orders[3];
  for (int run = 0; run < repeat; ++run) {
    tubes.push_back(solve_time(target, sweep, EdgeMethod::none, 1, threads));
    for (int order = 1; order <= 3; ++order)
      orders[order - 1].push_back(solve_time(target, sweep, EdgeMethod::fringe, order, threads));
  }
  fmt::print("{} triangles, {} wedges, {} looks, {} threads\n", loaded.mesh.triangles.size(), target.wedges.size(), looks,
             threads);
  fmt::print("tubes {:.3g} s; edge pass / tubes:", median(tubes));
  for (int order = 1; order <= 3; ++order) fmt::print("  order {}: {:.2f}", order, median(orders[order - 1]) / median(tubes) - 1);
  fmt::print("\n");
}
