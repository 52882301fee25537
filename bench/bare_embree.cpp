#include "bare_embree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/trace/embree.h"
#include "sbr/launch/launch.h"
#include "scene/material.h"
#include "timing.h"

namespace raytube::bench {

namespace {

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
  BareScene(const BareScene&) = delete;
  ~BareScene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  RTCDevice device;
  RTCScene scene;
};

// The rays of one look, sixteen at a time.
struct Recording {
  std::vector<RTCRayHit16> packets;
  std::uint64_t rays = 0, hits = 0;

  void append(const Ray& ray) {
    const std::size_t lane = rays++ % 16;
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
};

// Every ray the solver shoots for a look, in its order: rows of the grid, then the reflected rays of each bounce.
Recording record(const Tracer& tracer, const Look& look, double shortest, const TubeOptions& tubes) {
  const TriangleMesh& mesh = tracer.mesh();
  const LaunchGrid grid = launch_grid(mesh, look.transmit, shortest, tubes.per_wavelength, tubes.up);
  std::vector<Ray> rays;
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) rays.push_back(grid.ray(column, row));
  Recording recording;
  for (int bounce = 0; bounce <= tubes.max_bounces && !rays.empty(); ++bounce) {
    std::vector<Hit> hits(rays.size());
    tracer.closest_hits(rays, hits);
    std::vector<Ray> next;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      recording.append(rays[i]);
      if (!hits[i]) continue;
      ++recording.hits;
      const std::uint32_t patch = mesh.triangle_patch[hits[i].triangle];
      next.push_back({rays[i].origin + hits[i].distance * rays[i].direction,
                      reflected_direction(rays[i].direction, mesh.patches[patch].normal), patch});
    }
    rays = std::move(next);
  }
  return recording;
}

void shoot(RTCScene scene, std::vector<RTCRayHit16>& packets) {
  alignas(64) std::array<int, 16> valid;
  valid.fill(-1);
  for (RTCRayHit16& packet : packets) {
    embree::Query query;
    embree::intersect(scene, query, valid.data(), packet);
  }
}

// Rays are recorded anew before each shot because Embree writes into them; only the shots are timed.
void add_looks(BareTime& time, const BareScene& bare, std::vector<Recording>& recorded) {
  const auto start = Clock::now();
  tbb::parallel_for(std::size_t{0}, recorded.size(), [&](std::size_t i) { shoot(bare.scene, recorded[i].packets); });
  time.seconds += seconds_since(start);
  for (const Recording& look : recorded) time.rays += look.rays, time.hits += look.hits;
}

}  // namespace

BareTime bare_embree_time(const Target& target, const Sweep& sweep, const TubeOptions& tubes) {
  const double shortest = wavelength(*std::ranges::max_element(sweep.frequencies));
  constexpr std::size_t looks_at_a_time = 32;  // bounds memory
  const BareScene bare(target.mesh);
  BareTime time;
  for (std::size_t first = 0; first < sweep.looks.size(); first += looks_at_a_time) {
    std::vector<Recording> recorded(std::min(looks_at_a_time, sweep.looks.size() - first));
    tbb::parallel_for(std::size_t{0}, recorded.size(),
                      [&](std::size_t i) { recorded[i] = record(target.tracer, sweep.looks[first + i], shortest, tubes); });
    add_looks(time, bare, recorded);
  }
  return time;
}

}  // namespace raytube::bench
