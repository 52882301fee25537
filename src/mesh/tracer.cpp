#include "mesh/tracer.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

#include "mesh/exact_hit.h"

namespace raytube {

namespace {

constexpr std::size_t packet_width = 16;  // of what is loaded and decided together; Embree may be given less at a time

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
struct Packet;
}  // namespace

struct Tracer::Scene {
  Scene(const TriangleMesh& triangles, int rays_at_a_time);
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void intersect(std::span<const Ray> rays, QueryContext& context, bool from_behind, Packet& packet) const;
  void closest(std::span<const Ray> rays, std::span<std::uint32_t> found) const;
  std::uint32_t propose_beyond(const Ray& ray, std::span<const std::uint32_t> refused) const;
  void decide_again(const Ray& ray, std::uint32_t hint, std::uint32_t& found) const;
  std::uint32_t decide(const Ray& ray, std::uint32_t proposal) const;

  const TriangleMesh& mesh;
  ExactHit exact;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double scale = 1.0;
  int width;                      // rays that Embree is given at a time
  std::vector<float> safe_sides;  // ExactHit::safe_side in Embree's units

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

  bool refuses(const Ray& ray, std::uint32_t triangle) const {
    const std::uint32_t patch = exact->patch(triangle);
    return patch == ray.source_patch || std::ranges::find(refused_patches, patch) != refused_patches.end() ||
           std::ranges::find(refused_triangles, triangle) != refused_triangles.end() || !exact->ahead(ray, triangle) ||
           (must_contain && !exact->contains(ray, triangle));
  }
};

// The lanes whose flag is set (all ones), as bits. Of a whole packet the compiler takes them at once.
unsigned lanes_set(const int* flags, unsigned count) {
  unsigned bits = 0;
  if (count == packet_width)
    for (unsigned lane = 0; lane < packet_width; ++lane) bits |= static_cast<unsigned>(flags[lane]) & 1u << lane;
  else
    for (unsigned lane = 0; lane < count; ++lane) bits |= static_cast<unsigned>(flags[lane]) & 1u << lane;
  return bits;
}

// Keeps only hits that lie ahead of the ray's true start in double precision and are not on a refused surface.
void refuse_behind(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *static_cast<const QueryContext*>(arguments->context);
  for (unsigned left = lanes_set(arguments->valid, arguments->N); left != 0; left &= left - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(left));
    const Ray& ray = query.rays[RTCRayN_id(arguments->ray, arguments->N, lane)];
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, lane);
    if (query.refuses(ray, triangle)) arguments->valid[lane] = 0;
  }
}

// Sixteen rays with what Embree finds of them. Lanes beyond the last ray are inactive and repeat it: Embree computes with them
// all the same, and what was in memory may be subnormal numbers, a hundred times as slow.
struct alignas(64) Packet {
  RTCRayHit16 rays;
  std::array<int, packet_width> valid;
};

void load(Packet& packet, std::span<const Ray> rays, double scale, bool from_behind) {
  RTCRay16& to = packet.rays.ray;
  for (std::size_t lane = 0; lane < packet_width; ++lane) {
    const Ray& ray = rays[std::min(lane, rays.size() - 1)];
    const double behind = from_behind || ray.source_patch != no_index ? start_behind : 0.0;
    to.org_x[lane] = static_cast<float>(ray.origin.x * scale - behind * ray.direction.x);
    to.org_y[lane] = static_cast<float>(ray.origin.y * scale - behind * ray.direction.y);
    to.org_z[lane] = static_cast<float>(ray.origin.z * scale - behind * ray.direction.z);
    to.dir_x[lane] = static_cast<float>(ray.direction.x);
    to.dir_y[lane] = static_cast<float>(ray.direction.y);
    to.dir_z[lane] = static_cast<float>(ray.direction.z);
  }
  for (std::size_t lane = 0; lane < packet_width; ++lane) {
    packet.valid[lane] = lane < rays.size() ? -1 : 0;
    to.tnear[lane] = to.time[lane] = 0.0f;
    to.tfar[lane] = std::numeric_limits<float>::infinity();
    to.mask[lane] = 0xffffffffu;
    to.flags[lane] = 0;
    to.id[lane] = static_cast<unsigned>(lane);
    packet.rays.hit.geomID[lane] = packet.rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

bool is_hit(const Packet& packet, std::size_t lane) { return packet.rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }

// The smallest of the three edge functions of a hit - twice the area of the triangle, as the ray sees it, times a barycentric
// coordinate - in Embree's units and precision.
float smallest_side(const Packet& packet, std::size_t lane) {
  const RTCHit16& hit = packet.rays.hit;
  const RTCRay16& ray = packet.rays.ray;
  const float along = hit.Ng_x[lane] * ray.dir_x[lane] + hit.Ng_y[lane] * ray.dir_y[lane] + hit.Ng_z[lane] * ray.dir_z[lane];
  return std::min({hit.u[lane], hit.v[lane], 1.0f - hit.u[lane] - hit.v[lane]}) * std::abs(along);
}

void intersect_singly(RTCScene scene, RTCIntersectContext& context, Packet& packet) {
  auto* rays = reinterpret_cast<RTCRayHitN*>(&packet.rays);
  for (unsigned lane = 0; lane < packet_width; ++lane) {
    if (!packet.valid[lane]) continue;
    RTCRayHit single = rtcGetRayHitFromRayHitN(rays, packet_width, lane);
    rtcIntersect1(scene, &context, &single);
    rtcCopyHitToHitN(RTCRayHitN_HitN(rays, packet_width), &single.hit, packet_width, lane);
  }
}

// Both kinds of packet are rows of as many numbers of four bytes.
void intersect_halves(RTCScene scene, RTCIntersectContext& context, Packet& packet) {
  constexpr std::size_t half_width = packet_width / 2, half_row = 4 * half_width, rows = sizeof packet.rays / (2 * half_row);
  static_assert(sizeof(RTCRayHit8) == rows * half_row);
  for (std::size_t half = 0; half < 2; ++half) {
    alignas(32) RTCRayHit8 part;
    alignas(32) std::array<int, half_width> valid;
    std::copy_n(packet.valid.begin() + half * half_width, half_width, valid.begin());
    std::byte* const from = reinterpret_cast<std::byte*>(&packet.rays) + half * half_row;
    std::byte* const to = reinterpret_cast<std::byte*>(&part);
    for (std::size_t row = 0; row < rows; ++row) std::memcpy(to + row * half_row, from + 2 * row * half_row, half_row);
    rtcIntersect8(valid.data(), scene, &context, &part);
    for (std::size_t row = 0; row < rows; ++row) std::memcpy(from + 2 * row * half_row, to + row * half_row, half_row);
  }
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

Tracer::Scene::Scene(const TriangleMesh& triangles, int rays_at_a_time)
    : mesh(triangles), exact(triangles), width(rays_at_a_time) {
  device = rtcNewDevice("");
  if (!device) throw std::runtime_error("Embree cannot start on this machine");
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  if (mesh.radius > 0.0) scale = std::exp2(-std::ceil(std::log2(mesh.radius)));
  add_geometry();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    safe_sides.push_back(static_cast<float>(scale * scale * exact.safe_side(t)));
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

void Tracer::Scene::intersect(std::span<const Ray> rays, QueryContext& context, bool from_behind, Packet& packet) const {
  load(packet, rays, scale, from_behind);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  if (width == 1)
    intersect_singly(scene, context, packet);
  else if (width == 8)
    intersect_halves(scene, context, packet);
  else
    rtcIntersect16(packet.valid.data(), scene, &context, &packet.rays);
}

// What Embree says in single precision for one packet, and the final word on the rays it can be wrong about.
void Tracer::Scene::closest(std::span<const Ray> rays, std::span<std::uint32_t> found) const {
  const bool leaves_surface = std::ranges::any_of(rays, [](const Ray& ray) { return ray.source_patch != no_index; });
  QueryContext context = make_context(exact, rays.data());
  if (leaves_surface) context.filter = refuse_behind;
  Packet packet;
  intersect(rays, context, false, packet);
  for (std::size_t lane = 0; lane < rays.size(); ++lane) {
    found[lane] = is_hit(packet, lane) ? packet.rays.hit.primID[lane] : no_index;
    if (!is_hit(packet, lane) || smallest_side(packet, lane) > safe_sides[found[lane]]) continue;
    if (!exact.is_safe(rays[lane], found[lane])) found[lane] = decide(rays[lane], found[lane]);
  }
}

// The nearest surface other than the refused triangles, again in single precision.
std::uint32_t Tracer::Scene::propose_beyond(const Ray& ray, std::span<const std::uint32_t> refused) const {
  QueryContext context = make_context(exact, &ray);
  context.filter = refuse_behind;
  context.refused_triangles = refused;
  RTCRayHit query = single_ray(ray, scale);
  rtcIntersect1(scene, &context, &query);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? no_index : query.hit.primID;
}

// Full double-precision decision for a ray that passes close to an edge or meets surfaces that lie on one another: the nearest
// triangle that truly contains it, among the proposals and their neighbours. Each proposal is refused in turn, until what is
// left lies behind the best one beyond doubt.
std::uint32_t Tracer::Scene::decide(const Ray& ray, std::uint32_t proposal) const {
  Hit best;
  std::vector<std::uint32_t> refused;
  for (std::uint32_t next = proposal; next != no_index; next = propose_beyond(ray, refused)) {
    if (best && exact.distance(ray, next) > best.distance + exact.depth_doubt(ray, best.triangle)) break;
    const Hit hit = exact.nearest_around(ray, next, {ray.source_patch, no_index, no_index});
    if (hit && (!best || hit.distance < best.distance)) best = hit;
    if (best && !exact.is_stacked(best.triangle)) break;
    refused.push_back(next);
  }
  return best.triangle;
}

// A neighbouring ray met `hint`: does this ray, which was said to miss it or to go further, meet it after all?
void Tracer::Scene::decide_again(const Ray& ray, std::uint32_t hint, std::uint32_t& found) const {
  if (hint == no_index || hint == found || !exact.may_contain(ray, hint)) return;
  if (exact.patch(hint) == ray.source_patch || !exact.ahead(ray, hint)) return;
  if (found != no_index && exact.distance(ray, hint) >= exact.distance(ray, found)) return;
  if (exact.contains(ray, hint)) found = hint;
}

Tracer::Tracer(const TriangleMesh& mesh, int packet) : scene_(std::make_unique<Scene>(mesh, packet)) {}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

const TriangleMesh& Tracer::mesh() const { return scene_->mesh; }

void Tracer::closest_triangles(std::span<const Ray> rays, std::span<std::uint32_t> found) const {
  for (std::size_t first = 0; first < rays.size(); first += packet_width) {
    const std::size_t count = std::min(packet_width, rays.size() - first);
    scene_->closest(rays.subspan(first, count), found.subspan(first, count));
  }
  for (std::size_t i = 1; i < rays.size(); ++i) {
    const std::uint32_t before = found[i - 1], here = found[i];
    if (before == here) continue;
    scene_->decide_again(rays[i], before, found[i]);
    scene_->decide_again(rays[i - 1], here, found[i - 1]);
  }
}

void Tracer::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  std::vector<std::uint32_t> found(rays.size());
  closest_triangles(rays, found);
  for (std::size_t i = 0; i < rays.size(); ++i)
    hits[i] = {found[i], found[i] == no_index ? 0.0 : scene_->exact.distance(rays[i], found[i])};
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
    Packet answers;
    scene_->intersect(packet, context, true, answers);
    for (std::size_t lane = 0; lane < packet.size(); ++lane)
      found[first + lane] = is_hit(answers, lane) ? answers.rays.hit.primID[lane] : no_index;
  }
}

bool Tracer::meets_around(const dvec3& origin, const dvec3& direction, std::uint32_t triangle,
                          const IgnoredPatches& ignored_patches) const {
  return static_cast<bool>(scene_->exact.nearest_around({origin, direction}, triangle, ignored_patches));
}

std::string Tracer::instruction_set() const { return widest_instruction_set(); }

}  // namespace raytube
