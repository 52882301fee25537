#include "mesh/tracer.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/exact_hit.h"

namespace raytube {

namespace {

constexpr std::size_t packet_width = 16;

// Embree works on a copy of the mesh scaled to about unit size, so its absolute thresholds mean the same for every target.
// A ray that leaves a surface starts this far behind it (about 30 float roundings); what lies in between is refused in double.
constexpr double start_behind = 4e-6;

void check_device(RTCDevice device) {
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree reports error {}", static_cast<int>(error)));
}

// Embree's bit numbers of RTC_DEVICE_PROPERTY_NATIVE_RAY*_SUPPORTED do not tell AVX2 from AVX-512; the compiler's test does.
std::string widest_instruction_set() {
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512cd") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return "avx512";
  return "avx2";
}

}  // namespace

namespace {
struct QueryContext;
}

struct Tracer::Scene {
  explicit Scene(const TriangleMesh& triangles);
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void propose(std::span<const Ray> rays, std::span<Hit> hits) const;
  void intersect(std::span<const Ray> rays, QueryContext& context, bool from_behind, std::span<std::uint32_t> found) const;
  Hit propose_beyond(const Ray& ray, std::span<const std::uint32_t> refused) const;
  bool decide_again(const Ray& ray, std::uint32_t hint, Hit& hit) const;
  Hit decide(const Ray& ray, const Hit& proposal) const;

  const TriangleMesh& mesh;
  ExactHit exact;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double scale = 1.0;

 private:
  void add_geometry();
};

namespace {

// What the filter needs to know about the rays of a packet; Embree passes it back through the context.
struct QueryContext : RTCIntersectContext {
  const ExactHit* exact;
  const Ray* rays;
  std::span<const std::uint32_t> refused_triangles;
  IgnoredPatches refused_patches{no_index, no_index, no_index};
  bool must_contain = false;  // refuse triangles that the ray misses in double precision
};

// Keeps only hits that lie ahead of the ray's true start in double precision and are not on a refused surface.
void refuse_behind(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *static_cast<const QueryContext*>(arguments->context);
  for (unsigned lane = 0; lane < arguments->N; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const Ray& ray = query.rays[RTCRayN_id(arguments->ray, arguments->N, lane)];
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, lane);
    const std::uint32_t patch = query.exact->patch(triangle);
    const bool refused = patch == ray.source_patch ||
                         std::ranges::find(query.refused_patches, patch) != query.refused_patches.end() ||
                         std::ranges::find(query.refused_triangles, triangle) != query.refused_triangles.end() ||
                         !query.exact->ahead(ray, triangle) || (query.must_contain && !query.exact->contains(ray, triangle));
    if (refused) arguments->valid[lane] = 0;
  }
}

template <class RayPacket>
void load_lane(RayPacket& packet, std::size_t lane, const Ray& ray, double scale, bool from_behind) {
  const dvec3 origin = from_behind ? ray.origin * scale - start_behind * ray.direction : ray.origin * scale;
  packet.org_x[lane] = static_cast<float>(origin.x);
  packet.org_y[lane] = static_cast<float>(origin.y);
  packet.org_z[lane] = static_cast<float>(origin.z);
  packet.dir_x[lane] = static_cast<float>(ray.direction.x);
  packet.dir_y[lane] = static_cast<float>(ray.direction.y);
  packet.dir_z[lane] = static_cast<float>(ray.direction.z);
  packet.tnear[lane] = 0.0f;
  packet.tfar[lane] = std::numeric_limits<float>::infinity();
  packet.time[lane] = 0.0f;
  packet.mask[lane] = 0xffffffffu;
  packet.flags[lane] = 0;
  packet.id[lane] = static_cast<unsigned>(lane);
}

RTCRayHit single_ray(const Ray& ray, double scale) {
  RTCRayHit query{};
  const dvec3 origin = ray.origin * scale - start_behind * ray.direction;
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = static_cast<float>(ray.direction.x);
  query.ray.dir_y = static_cast<float>(ray.direction.y);
  query.ray.dir_z = static_cast<float>(ray.direction.z);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xffffffffu;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

QueryContext make_context(const ExactHit& exact, const Ray* rays) {
  QueryContext context;
  rtcInitIntersectContext(&context);
  context.exact = &exact;
  context.rays = rays;
  return context;
}

QueryContext blocker_context(const ExactHit& exact, const Ray* rays, const IgnoredPatches& ignored_patches) {
  QueryContext context = make_context(exact, rays);
  context.filter = refuse_behind;
  context.refused_patches = ignored_patches;
  context.must_contain = true;
  return context;
}

}  // namespace

Tracer::Scene::Scene(const TriangleMesh& triangles) : mesh(triangles), exact(triangles) {
  device = rtcNewDevice("");
  if (!device) throw std::runtime_error("Embree cannot start on this machine");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  if (mesh.radius > 0.0) scale = std::exp2(-std::ceil(std::log2(mesh.radius)));
  add_geometry();
  // One thread: the order of equal leaves then never depends on the machine's load.
  tbb::task_arena(1).execute([this] { rtcJoinCommitScene(scene); });
  check_device(device);
}

void Tracer::Scene::add_geometry() {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
  check_device(device);
  for (const dvec3& vertex : mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(vertex[axis] * scale);
  for (const auto& triangle : mesh.triangles) indices = std::ranges::copy(triangle, indices).out;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

// Single-precision answers for all rays, sixteen at a time.
void Tracer::Scene::propose(std::span<const Ray> rays, std::span<Hit> hits) const {
  std::array<std::uint32_t, packet_width> found;
  for (std::size_t first = 0; first < rays.size(); first += packet_width) {
    const std::span<const Ray> packet = rays.subspan(first, std::min(packet_width, rays.size() - first));
    const bool leaves_surface = std::ranges::any_of(packet, [](const Ray& ray) { return ray.source_patch != no_index; });
    QueryContext context = make_context(exact, packet.data());
    if (leaves_surface) context.filter = refuse_behind;
    intersect(packet, context, false, found);
    for (std::size_t lane = 0; lane < packet.size(); ++lane) hits[first + lane].triangle = found[lane];
  }
}

// One packet.
void Tracer::Scene::intersect(std::span<const Ray> rays, QueryContext& context, bool from_behind,
                              std::span<std::uint32_t> found) const {
  alignas(64) RTCRayHit16 packet;
  alignas(64) std::array<int, packet_width> valid{};
  for (std::size_t lane = 0; lane < rays.size(); ++lane) {
    load_lane(packet.ray, lane, rays[lane], scale, from_behind || rays[lane].source_patch != no_index);
    valid[lane] = -1;
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  }
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid.data(), scene, &context, &packet);
  for (std::size_t lane = 0; lane < rays.size(); ++lane)
    found[lane] = packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? no_index : packet.hit.primID[lane];
}

// The nearest surface other than the refused triangles, again in single precision.
Hit Tracer::Scene::propose_beyond(const Ray& ray, std::span<const std::uint32_t> refused) const {
  QueryContext context = make_context(exact, &ray);
  context.filter = refuse_behind;
  context.refused_triangles = refused;
  RTCRayHit query = single_ray(ray, scale);
  rtcIntersect1(scene, &context, &query);
  return {query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? no_index : query.hit.primID, 0.0};
}

// Full double-precision decision for a ray that passes close to an edge or meets surfaces that lie on one another: the nearest
// triangle that truly contains it, among the proposals and their neighbours. Each proposal is refused in turn, until what is
// left lies behind the best one beyond doubt.
Hit Tracer::Scene::decide(const Ray& ray, const Hit& proposal) const {
  Hit best;
  std::vector<std::uint32_t> refused;
  for (Hit next = proposal; next; next = propose_beyond(ray, refused)) {
    if (best && exact.distance(ray, next.triangle) > best.distance + exact.depth_doubt(ray, best.triangle)) break;
    const Hit hit = exact.nearest_around(ray, next.triangle, {ray.source_patch, no_index, no_index});
    if (hit && (!best || hit.distance < best.distance)) best = hit;
    if (best && !exact.is_stacked(best.triangle)) break;
    refused.push_back(next.triangle);
  }
  return best;
}

// A neighbouring ray met `hint`: does this ray, which was said to miss it or to go further, meet it after all?
bool Tracer::Scene::decide_again(const Ray& ray, std::uint32_t hint, Hit& hit) const {
  if (hint == hit.triangle || exact.patch(hint) == ray.source_patch || !exact.ahead(ray, hint)) return false;
  const double distance = exact.distance(ray, hint);
  if (hit && distance >= hit.distance) return false;
  if (!exact.contains(ray, hint)) return false;
  hit = {hint, distance};
  return true;
}

Tracer::Tracer(const TriangleMesh& mesh) : scene_(std::make_unique<Scene>(mesh)) {}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

const TriangleMesh& Tracer::mesh() const { return scene_->mesh; }

void Tracer::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  scene_->propose(rays, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i]) continue;
    if (scene_->exact.is_safe(rays[i], hits[i].triangle))
      hits[i].distance = scene_->exact.distance(rays[i], hits[i].triangle);
    else
      hits[i] = scene_->decide(rays[i], hits[i]);
  }
  for (std::size_t i = 1; i < rays.size(); ++i) {
    const Hit before = hits[i - 1], here = hits[i];
    if (before.triangle == here.triangle) continue;
    if (before) scene_->decide_again(rays[i], before.triangle, hits[i]);
    if (here) scene_->decide_again(rays[i - 1], here.triangle, hits[i - 1]);
  }
}

std::uint32_t Tracer::blocker(const dvec3& origin, const dvec3& direction, const IgnoredPatches& ignored_patches) const {
  const Ray ray{origin, direction};
  QueryContext context = blocker_context(scene_->exact, &ray, ignored_patches);
  RTCRayHit query = single_ray(ray, scene_->scale);
  rtcIntersect1(scene_->scene, &context, &query);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? no_index : query.hit.primID;
}

void Tracer::blockers(std::span<const Ray> rays, const IgnoredPatches& ignored_patches, std::span<std::uint32_t> found) const {
  for (std::size_t first = 0; first < rays.size(); first += packet_width) {
    const std::span<const Ray> packet = rays.subspan(first, std::min(packet_width, rays.size() - first));
    QueryContext context = blocker_context(scene_->exact, packet.data(), ignored_patches);
    scene_->intersect(packet, context, true, found.subspan(first, packet.size()));
  }
}

bool Tracer::meets_around(const dvec3& origin, const dvec3& direction, std::uint32_t triangle,
                          const IgnoredPatches& ignored_patches) const {
  return static_cast<bool>(scene_->exact.nearest_around({origin, direction}, triangle, ignored_patches));
}

std::string Tracer::instruction_set() const { return widest_instruction_set(); }

}  // namespace raytube
