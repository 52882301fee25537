#include "mesh/trace/tracer.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/instruction_set.h"
#include "mesh/model/geometry.h"
#include "mesh/trace/exact_hit.h"
#include "mesh/trace/packet.h"
#include "mesh/trace/proxy_triangles.h"

namespace raytube {

namespace {

// Of the proxy triangles: twenty times the distance by which single precision can mistake a point.
constexpr double proxy_margin = 2e-5;

// Embree calls it unknown when a thread or an allocation of its own fails.
[[noreturn]] void fail(RTCError error) {
  if (error == RTC_ERROR_OUT_OF_MEMORY || error == RTC_ERROR_UNKNOWN) throw std::bad_alloc();
  throw std::runtime_error(
      fmt::format("Embree reports error {}; install Embree 3.13 or 4 as your system has it", static_cast<int>(error)));
}

void check_device(RTCDevice device) {
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE) fail(error);
}

// One of Embree's triangles, and how far along the ray it found it [m].
struct Proposal {
  std::uint32_t primitive = no_index;
  double distance = 0.0;
  explicit operator bool() const { return primitive != no_index; }
};
}  // namespace

struct Tracer::Scene {
  Scene(const TriangleMesh& triangles, int rays_at_a_time);
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void closest(std::span<const Ray> rays, int at_a_time, std::span<std::uint32_t> found) const;
  void any(std::span<const Ray> rays, const IgnoredPatches& ignored, std::span<std::uint32_t> found) const;
  Proposal propose_beyond(const Ray& ray, const IgnoredPatches& ignored, std::span<const std::uint32_t> refused) const;
  std::uint32_t decide(const Ray& ray, const IgnoredPatches& ignored, Proposal proposal) const;
  std::uint32_t ask_alone(const Ray& ray, const IgnoredPatches& ignored) const;
  bool is_lost(const Ray& ray, std::uint32_t triangle) const { return triangle != no_index && exact->is_lost(ray, triangle); }
  std::uint32_t found_again(const Ray& ray, std::uint32_t lost) const;
  bool is_safe(std::uint32_t primitive, float side) const {
    return primitive < safe_sides.size() && side > safe_sides[primitive];
  }
  bool is_inside(const Ray& ray, std::uint32_t primitive, float side) const {
    return is_safe(primitive, side) || (primitive < safe_sides.size() && exact->is_inside(ray, primitive));
  }

  const TriangleMesh& mesh;
  std::optional<ExactHit> exact;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  double scale;
  int width;                          // rays that Embree is given at a time
  std::vector<std::uint32_t> source;  // of each of Embree's triangles, that of the mesh
  std::vector<float> safe_sides;  // of each triangle of the mesh: smallest_side() of hits that single precision cannot mistake

 private:
  void build();
  void add_geometry(const ProxyTriangles& proxies);
  float safe_side(const ProxyTriangles& proxies, std::uint32_t triangle) const;
};

namespace {

// What the filter needs to know about the rays of a packet; Embree passes it back through the context.
struct QueryContext : embree::Query {
  const ExactHit* exact;
  std::size_t own;  // of Embree's triangles the first ones are the mesh's
  const Ray* rays;
  IgnoredPatches refused_patches;
  std::span<const std::uint32_t> refused_primitives;

  bool refuses(const Ray& ray, std::uint32_t primitive) const {
    if (std::ranges::find(refused_primitives, primitive) != refused_primitives.end()) return true;
    if (primitive >= own) return false;  // a proxy triangle across an edge stands for the neighbours there too
    const std::uint32_t patch = exact->patch(primitive);
    return patch == ray.source_patch || std::ranges::find(refused_patches, patch) != refused_patches.end() ||
           !exact->ahead(ray, primitive);
  }
};

// Keeps only hits that lie ahead of the ray's true start in double precision and are not on a refused surface.
void refuse(const RTCFilterFunctionNArguments* arguments) {
  const auto& query = *static_cast<const QueryContext*>(arguments->context);
  for (unsigned left = embree::lanes_set(arguments->valid, arguments->N); left != 0; left &= left - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(left));
    const Ray& ray = query.rays[RTCRayN_id(arguments->ray, arguments->N, lane)];
    if (query.refuses(ray, RTCHitN_primID(arguments->hit, arguments->N, lane))) arguments->valid[lane] = 0;
  }
}

// A query for any hit: which rays met what beyond doubt, and which met something that they may miss.
struct AnyContext : QueryContext {
  const Tracer::Scene* scene;
  std::span<std::uint32_t> found;
  std::vector<std::pair<unsigned, std::uint32_t>> doubtful{};  // rays and triangles that they, or neighbours, may meet

  // Inactive lanes repeat the last ray.
  void doubt(unsigned ray, std::uint32_t triangle) {
    if (std::ranges::find(doubtful, std::pair(ray, triangle)) == doubtful.end()) doubtful.emplace_back(ray, triangle);
  }
};

// Ends a ray at a triangle that it meets beyond doubt.
void keep_any(const RTCFilterFunctionNArguments* arguments) {
  auto& query = *static_cast<AnyContext*>(arguments->context);
  for (unsigned left = embree::lanes_set(arguments->valid, arguments->N); left != 0; left &= left - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(left));
    const unsigned index = RTCRayN_id(arguments->ray, arguments->N, lane);
    const Ray& ray = query.rays[index];
    const std::uint32_t primitive = RTCHitN_primID(arguments->hit, arguments->N, lane), triangle = query.scene->source[primitive];
    arguments->valid[lane] = 0;
    if (query.refuses(ray, primitive)) continue;
    if (query.scene->is_safe(primitive, embree::smallest_side(*arguments, lane)) ||
        query.scene->exact->meets(ray, triangle, query.refused_patches))
      query.found[index] = triangle, arguments->valid[lane] = -1;
    else
      query.doubt(index, triangle);
  }
}

// To about unit size.
double scale_of(const TriangleMesh& mesh) { return mesh.radius > 0.0 ? std::exp2(-std::ceil(std::log2(mesh.radius))) : 1.0; }

template <class Context>
Context make_context(const Tracer::Scene& scene, const Ray* rays, const IgnoredPatches& ignored) {
  Context context;
  context.exact = &*scene.exact;
  context.own = scene.safe_sides.size();
  context.rays = rays;
  context.refused_patches = ignored;
  return context;
}

}  // namespace

// The two halves of what a mesh needs are built side by side.
Tracer::Scene::Scene(const TriangleMesh& triangles, int rays_at_a_time)
    : mesh(triangles), scale(scale_of(triangles)), width(rays_at_a_time) {
  tbb::parallel_invoke([&] { exact.emplace(mesh); }, [&] { build(); });
}

// Embree's half.
void Tracer::Scene::build() {
  ProxyTriangles proxies = proxy_triangles(mesh, proxy_margin / scale);
  // As many user threads as there are threads leave none to Embree, and one builds: the order of equal leaves then never depends
  // on the machine's load.
  device = rtcNewDevice(fmt::format("isa={},user_threads=1000000", name_of(allowed_instruction_set())).c_str());
  if (!device) fail(rtcGetDeviceError(nullptr));
  scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | embree::filter_of_queries));
  add_geometry(proxies);
  safe_sides.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) safe_sides.push_back(safe_side(proxies, t));
  source = std::move(proxies.source);
  proxies = {};  // Embree has its own copy, and needs the memory
  rtcJoinCommitScene(scene);
  check_device(device);
}

void Tracer::Scene::add_geometry(const ProxyTriangles& proxies) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), proxies.vertices.size()));
  auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), proxies.triangles.size()));
  check_device(device);
  for (const dvec3& vertex : proxies.vertices)
    for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(vertex[axis] * scale);
  for (const auto& triangle : proxies.triangles) indices = std::ranges::copy(triangle, indices).out;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

// Edge functions fall by how far a corner was moved times the edge when the corner is put back.
float Tracer::Scene::safe_side(const ProxyTriangles& proxies, std::uint32_t triangle) const {
  const Triangle& corners = proxies.triangles[triangle];
  const int k = longest_edge(proxies.vertices, corners);
  const double edge = glm::distance(proxies.vertices[corners[k]], proxies.vertices[corners[(k + 1) % 3]]);
  return static_cast<float>(scale * scale * edge * (2.0 * ExactHit::edge_uncertainty(mesh) + proxies.moved[triangle]));
}

// What Embree says in single precision for one packet, and the final word on the rays it can be wrong about.
void Tracer::Scene::closest(std::span<const Ray> rays, int at_a_time, std::span<std::uint32_t> found) const {
  const IgnoredPatches& ignored = nothing_ignored;
  const bool leaves_surface = std::ranges::any_of(rays, [](const Ray& ray) { return ray.source_patch != no_index; });
  auto context = make_context<QueryContext>(*this, rays.data(), ignored);
  if (leaves_surface) context.filter = refuse;
  embree::Packet packet;
  embree::load(packet, rays, scale, false);
  embree::intersect(scene, context, at_a_time, packet);
  for (std::size_t lane = 0; lane < rays.size(); ++lane) {
    found[lane] = embree::is_hit(packet, lane) ? packet.rays.hit.primID[lane] : no_index;
    if (!embree::is_hit(packet, lane)) continue;
    if (!is_inside(rays[lane], found[lane], embree::smallest_side(packet, lane)))
      found[lane] = decide(rays[lane], ignored, {found[lane], (packet.start[lane] + packet.rays.ray.tfar[lane]) / scale});
    else if (!exact->is_alone(found[lane]))
      found[lane] =
          exact->front_of(rays[lane], exact->nearest_near_coincident(rays[lane], found[lane], ignored), ignored).triangle;
    if (rays[lane].source_patch != no_index && is_lost(rays[lane], found[lane]))
      found[lane] = found_again(rays[lane], found[lane]);
  }
}

// The first of Embree's proposals for each ray that is right beyond doubt; where it has none but doubtful ones, one of these or
// of the triangles that single precision can confuse with it.
void Tracer::Scene::any(std::span<const Ray> rays, const IgnoredPatches& ignored, std::span<std::uint32_t> found) const {
  std::ranges::fill(found, no_index);
  auto context = make_context<AnyContext>(*this, rays.data(), ignored);
  context.filter = keep_any;
  context.scene = this;
  context.found = found;
  if (width == 1 || rays.size() == 1)
    embree::occlude_singly(scene, context, scale, rays);
  else
    embree::occlude(scene, context, scale, rays);
  for (const auto& [ray, triangle] : context.doubtful)
    if (found[ray] == no_index) found[ray] = exact->nearest_around(rays[ray], triangle, ignored).triangle;
}

std::uint32_t Tracer::Scene::ask_alone(const Ray& ray, const IgnoredPatches& ignored) const {
  const Proposal first = propose_beyond(ray, ignored, {});
  return first ? decide(ray, ignored, first) : no_index;
}

// A ray starts on the plane of its patch. Beside an edge that may be beneath the facets of another patch: of one that it leaves
// upwards, and did not meet, or of one that it would have met at once, and runs through the body from there. Such a ray is asked
// again, without that patch, or from the way on which it came.
std::uint32_t Tracer::Scene::found_again(const Ray& ray, std::uint32_t lost) const {
  std::uint32_t found = lost;
  if (exact->begins_beneath(ray, lost)) found = ask_alone(ray, {exact->patch(lost), no_index, no_index});
  if (is_lost(ray, found)) found = ask_alone(exact->moved_back(ray), nothing_ignored);
  return is_lost(ray, found) ? lost : found;
}

// The nearest of Embree's triangles other than the refused ones.
Proposal Tracer::Scene::propose_beyond(const Ray& ray, const IgnoredPatches& ignored,
                                       std::span<const std::uint32_t> refused) const {
  auto context = make_context<QueryContext>(*this, &ray, ignored);
  context.filter = refuse;
  context.refused_primitives = refused;
  const double start = embree::start_of(ray, scale, true);
  RTCRayHit query = embree::single_ray(ray, scale, start);
  embree::intersect(scene, context, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {query.hit.primID, (start + query.ray.tfar) / scale};
}

// Full double-precision decision for a ray that passes close to an edge or meets near-coincident facets: the nearest triangle
// that truly contains it, among what Embree proposes and its neighbours. Each proposal is refused in turn, until one holds where
// it was proposed - what single precision can confuse with it are its neighbours - or what is left lies behind the best one.
std::uint32_t Tracer::Scene::decide(const Ray& ray, const IgnoredPatches& ignored, Proposal proposal) const {
  Hit best;
  std::vector<std::uint32_t> refused;
  for (Proposal next = proposal; next; next = propose_beyond(ray, ignored, refused)) {
    if (best && next.distance > best.distance + exact->edge_uncertainty()) break;
    const Hit hit = exact->nearest_around(ray, source[next.primitive], ignored);
    if (hit && (!best || std::pair(hit.distance, hit.triangle) < std::pair(best.distance, best.triangle))) best = hit;
    if (best.triangle == next.primitive && best.distance <= next.distance + exact->edge_uncertainty()) break;
    if (std::ranges::find(refused, next.primitive) != refused.end())
      throw std::logic_error("Embree proposes a triangle again that its filter refused: it does not call the filter");
    refused.push_back(next.primitive);
  }
  return best ? exact->front_of(ray, best, ignored).triangle : no_index;
}

Tracer::Tracer(const TriangleMesh& mesh, int packet) : scene_(std::make_unique<Scene>(mesh, packet)) {}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

const TriangleMesh& Tracer::mesh() const { return scene_->mesh; }

std::span<const std::uint32_t> Tracer::near_coincident(std::uint32_t triangle) const {
  return scene_->exact->near_coincident(triangle);
}

void Tracer::closest_hits(std::span<const Ray> rays, std::span<Hit> hits, bool side_by_side) const {
  std::array<std::uint32_t, embree::packet_width> found;
  for (std::size_t first = 0; first < rays.size(); first += embree::packet_width) {
    const std::size_t count = std::min(embree::packet_width, rays.size() - first);
    scene_->closest(rays.subspan(first, count), side_by_side && count > 1 ? scene_->width : 1, found);
    for (std::size_t i = 0; i < count; ++i) hits[first + i] = scene_->exact->hit(rays[first + i], found[i]);
  }
}

std::uint32_t Tracer::blocker(const dvec3& origin, const dvec3& direction, const IgnoredPatches& ignored_patches) const {
  return scene_->ask_alone({origin, direction}, ignored_patches);
}

void Tracer::any_blockers(std::span<const Ray> rays, const IgnoredPatches& ignored_patches,
                          std::span<std::uint32_t> found) const {
  for (std::size_t first = 0; first < rays.size(); first += embree::packet_width) {
    const std::size_t count = std::min(embree::packet_width, rays.size() - first);
    scene_->any(rays.subspan(first, count), ignored_patches, found.subspan(first, count));
  }
}

std::uint32_t Tracer::blocker_around(const dvec3& origin, const dvec3& direction, std::uint32_t triangle,
                                     const IgnoredPatches& ignored_patches) const {
  const Ray ray{origin, direction};
  return is_finite(ray) ? scene_->exact->nearest_around(ray, triangle, ignored_patches).triangle : no_index;
}

}  // namespace raytube
