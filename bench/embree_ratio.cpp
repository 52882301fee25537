// Solver time of a case beside the time bare rtcIntersect16 takes for the very same rays, in one run on one machine.
//   embree_ratio [--threads N] [--repeat N] CASE.toml...
// Prints, per case, the median of N runs of each (taken in turn) and their ratio. No plots, no files.
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>

#include "case/case.h"
#include "material.h"
#include "sbr/launch.h"

namespace {

using namespace raytube;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + values.size() / 2);
  return values[values.size() / 2];
}

// The mesh in Embree, with nothing around it.
struct BareScene {
  explicit BareScene(const TriangleMesh& mesh) : device(rtcNewDevice("")), scene(rtcNewScene(device)) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertices.size()));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    for (const dvec3& v : mesh.vertices)
      for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(v[axis]);
    for (const auto& t : mesh.triangles) indices = std::ranges::copy(t, indices).out;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  ~BareScene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  RTCDevice device;
  RTCScene scene;
};

using Packets = std::vector<RTCRayHit16>;

void append(Packets& packets, std::size_t& count, const Ray& ray) {
  const std::size_t lane = count++ % 16;
  if (lane == 0) {
    packets.emplace_back();
    std::ranges::fill(packets.back().ray.tfar, -1.0f);  // unused lanes stay inactive
    std::ranges::fill(packets.back().hit.geomID, RTC_INVALID_GEOMETRY_ID);
  }
  RTCRay16& r = packets.back().ray;
  r.org_x[lane] = static_cast<float>(ray.origin.x), r.org_y[lane] = static_cast<float>(ray.origin.y),
  r.org_z[lane] = static_cast<float>(ray.origin.z);
  r.dir_x[lane] = static_cast<float>(ray.direction.x), r.dir_y[lane] = static_cast<float>(ray.direction.y),
  r.dir_z[lane] = static_cast<float>(ray.direction.z);
  r.tnear[lane] = ray.source_patch == no_index ? 0.0f : 1e-5f;
  r.tfar[lane] = std::numeric_limits<float>::infinity();
  r.mask[lane] = 0xffffffffu;
}

// Every ray the solver shoots for a look, in its order: rows of the grid, then the reflected rays of each bounce.
Packets record(const Tracer& tracer, const Look& look, double shortest, const TubeOptions& tubes) {
  const TriangleMesh& mesh = tracer.mesh();
  const LaunchGrid grid = launch_grid(mesh, look.transmit, shortest, tubes.per_wavelength, tubes.up);
  std::vector<Ray> rays;
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) rays.push_back(grid.ray(column, row));
  Packets packets;
  std::size_t count = 0;
  for (int bounce = 0; bounce <= tubes.max_bounces && !rays.empty(); ++bounce) {
    std::vector<Hit> hits(rays.size());
    tracer.closest_hits(rays, hits);
    std::vector<Ray> next;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      append(packets, count, rays[i]);
      if (!hits[i]) continue;
      const std::uint32_t patch = mesh.triangle_patch[hits[i].triangle];
      next.push_back({rays[i].origin + hits[i].distance * rays[i].direction,
                      reflected_direction(rays[i].direction, mesh.patches[patch].normal), patch});
    }
    rays = std::move(next);
  }
  return packets;
}

void shoot(RTCScene scene, Packets& packets) {
  alignas(64) std::array<int, 16> valid;
  valid.fill(-1);
  for (RTCRayHit16& packet : packets) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), scene, &context, &packet);
  }
}

double bare_time(const BareScene& bare, const Target& target, const Case& c) {
  const double shortest = wavelength(*std::ranges::max_element(c.sweep.frequencies));
  constexpr std::size_t looks_at_a_time = 32;
  double total = 0.0;
  for (std::size_t first = 0; first < c.sweep.looks.size(); first += looks_at_a_time) {
    std::vector<Packets> recorded(std::min(looks_at_a_time, c.sweep.looks.size() - first));
    tbb::parallel_for(std::size_t{0}, recorded.size(),
                      [&](std::size_t i) { recorded[i] = record(target.tracer, c.sweep.looks[first + i], shortest, c.tubes); });
    const auto start = Clock::now();
    tbb::parallel_for(std::size_t{0}, recorded.size(), [&](std::size_t i) { shoot(bare.scene, recorded[i]); });
    total += seconds_since(start);
  }
  return total;
}

void measure(const std::string& file, int threads, int repeat) {
  const Case c = read_case(file);
  const LoadedMesh loaded = load_mesh(c.mesh_file, c.metres_per_unit);
  const Target target(loaded.mesh, c.edges);
  const BareScene bare(loaded.mesh);
  SolveOptions options;
  options.tubes = c.tubes;
  options.edges.method = EdgeMethod::none;
  options.threads = threads;
  std::vector<double> solver, embree, ratio;
  std::uint64_t rays = 0;
  for (int i = 0; i < repeat; ++i) {
    const SweepResult result = solve(target, c.sweep, options);
    rays = result.statistics.rays;
    solver.push_back(result.statistics.solve_s);
    embree.push_back(bare_time(bare, target, c));
    ratio.push_back(solver.back() / embree.back());
  }
  fmt::print("{}: {} rays, solve {:.3f} s, bare rtcIntersect16 {:.3f} s, ratio {:.2f} (medians of {}, {} threads)\n", c.title,
             rays, median(solver), median(embree), median(ratio), repeat, threads);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Solver time against bare Embree on the same rays");
  int threads = 2, repeat = 5;
  std::vector<std::string> cases;
  app.add_option("--threads", threads);
  app.add_option("--repeat", repeat);
  app.add_option("cases", cases)->required();
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena(threads).execute([&] {
    for (const std::string& file : cases) measure(file, threads, repeat);
  });
}
