// Rays as Embree takes them, in single precision: alone, or sixteen side by side. For tracer.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "mesh/trace/embree.h"
#include "mesh/trace/ray.h"

namespace raytube::embree {

inline constexpr std::size_t packet_width = 16;  // rays that are loaded and decided together; Embree may be given fewer

// Embree works on a copy of the mesh scaled to about unit size, so its absolute thresholds mean the same for every target.
// A ray that leaves a surface starts this far behind it (about 30 float roundings); what lies in between is refused in double.
inline constexpr double start_behind = 4e-6;
// A ray from afar starts this far from the middle of the mesh, so that single precision places it as well as the others.
inline constexpr double start_from = 2.0;
// Embree takes components of a direction below 1e-18 as +1e-18. In a packet with a negative one that is not what its sign says,
// and surfaces that other rays of the packet meet are passed over.
inline constexpr double least_component = 1e-17;
// Embree may end the program at a ray whose numbers are not finite, or beyond 1.8e18.
inline constexpr float largest_number = 1e18f;

// The lanes whose flag is set (all ones), as bits. Of a whole packet the compiler takes them at once.
inline unsigned lanes_set(const int* flags, unsigned count) {
  unsigned bits = 0;
  if (count == packet_width)
    for (unsigned lane = 0; lane < packet_width; ++lane) bits |= static_cast<unsigned>(flags[lane]) & 1u << lane;
  else
    for (unsigned lane = 0; lane < count; ++lane) bits |= static_cast<unsigned>(flags[lane]) & 1u << lane;
  return bits;
}

// Sixteen rays with what Embree finds of them. Lanes beyond the last ray are inactive and repeat it: Embree computes with them
// all the same and asks its filter about them, and what was in memory may be subnormal numbers, a hundred times as slow.
struct alignas(64) Packet {
  RTCRayHit16 rays;
  std::array<int, packet_width> valid;
  std::array<double, packet_width> start;  // along each ray [Embree's units]
};

// Where along it a ray begins for Embree, in its units.
inline double start_of(const Ray& ray, double scale, bool from_behind) {
  const double towards = -scale * glm::dot(ray.origin, ray.direction) - start_from;
  return towards > 0.0 ? towards : from_behind || ray.source_patch != no_index ? -start_behind : 0.0;
}

inline float direction_component(double x) { return std::abs(x) < least_component ? 0.0f : static_cast<float>(x); }

// Whether Embree takes a ray of such numbers; not if one of them is none.
inline bool can_be_traced(float origin_x, float origin_y, float origin_z, float x, float y, float z) {
  return origin_x * origin_x + origin_y * origin_y + origin_z * origin_z + x * x + y * y + z * z <=
         largest_number * largest_number;
}

// Places a ray outside the mesh, and turns it away from it.
template <class To>
void meet_nothing(To&& origin_x, To&& origin_y, To&& origin_z, To&& x, To&& y, To&& z) {
  origin_x = origin_y = x = y = 0.0f, origin_z = 4.0f, z = 1.0f;
}

inline void park_strays(RTCRay16& rays) {
  for (std::size_t i = 0; i < packet_width; ++i)
    if (!can_be_traced(rays.org_x[i], rays.org_y[i], rays.org_z[i], rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]))
      meet_nothing(rays.org_x[i], rays.org_y[i], rays.org_z[i], rays.dir_x[i], rays.dir_y[i], rays.dir_z[i]);
}

inline void load(Packet& packet, std::span<const Ray> rays, double scale, bool from_behind) {
  RTCRay16& to = packet.rays.ray;
  for (std::size_t lane = 0; lane < packet_width; ++lane) {
    const std::size_t index = std::min(lane, rays.size() - 1);
    const Ray& ray = rays[index];
    const double start = packet.start[lane] = start_of(ray, scale, from_behind);
    to.org_x[lane] = static_cast<float>(ray.origin.x * scale + start * ray.direction.x);
    to.org_y[lane] = static_cast<float>(ray.origin.y * scale + start * ray.direction.y);
    to.org_z[lane] = static_cast<float>(ray.origin.z * scale + start * ray.direction.z);
    to.dir_x[lane] = direction_component(ray.direction.x);
    to.dir_y[lane] = direction_component(ray.direction.y);
    to.dir_z[lane] = direction_component(ray.direction.z);
    to.id[lane] = static_cast<unsigned>(index);
  }
  int strays = 0;
  for (std::size_t lane = 0; lane < packet_width; ++lane)
    strays |=
        can_be_traced(to.org_x[lane], to.org_y[lane], to.org_z[lane], to.dir_x[lane], to.dir_y[lane], to.dir_z[lane]) ? 0 : 1;
  if (strays != 0) park_strays(to);
  for (std::size_t lane = 0; lane < packet_width; ++lane) {
    packet.valid[lane] = lane < rays.size() ? -1 : 0;
    to.tnear[lane] = to.time[lane] = 0.0f;
    to.tfar[lane] = std::numeric_limits<float>::infinity();
    to.mask[lane] = 0xffffffffu;
    to.flags[lane] = 0;
    packet.rays.hit.geomID[lane] = packet.rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

inline bool is_hit(const Packet& packet, std::size_t lane) { return packet.rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID; }

// The smallest of the three edge functions of a hit - twice the area of the triangle, as the ray sees it, times a barycentric
// coordinate - in Embree's units and precision.
inline float smallest_side(float u, float v, float along) { return std::min({u, v, 1.0f - u - v}) * std::abs(along); }

inline float smallest_side(const Packet& packet, std::size_t lane) {
  const RTCHit16& hit = packet.rays.hit;
  const RTCRay16& ray = packet.rays.ray;
  const float along = hit.Ng_x[lane] * ray.dir_x[lane] + hit.Ng_y[lane] * ray.dir_y[lane] + hit.Ng_z[lane] * ray.dir_z[lane];
  return smallest_side(hit.u[lane], hit.v[lane], along);
}

inline float smallest_side(const RTCFilterFunctionNArguments& of, unsigned lane) {
  const float along = RTCHitN_Ng_x(of.hit, of.N, lane) * RTCRayN_dir_x(of.ray, of.N, lane) +
                      RTCHitN_Ng_y(of.hit, of.N, lane) * RTCRayN_dir_y(of.ray, of.N, lane) +
                      RTCHitN_Ng_z(of.hit, of.N, lane) * RTCRayN_dir_z(of.ray, of.N, lane);
  return smallest_side(RTCHitN_u(of.hit, of.N, lane), RTCHitN_v(of.hit, of.N, lane), along);
}

inline void intersect_singly(RTCScene scene, Query& query, Packet& packet) {
  auto* rays = reinterpret_cast<RTCRayHitN*>(&packet.rays);
  for (unsigned lane = 0; lane < packet_width; ++lane) {
    if (!packet.valid[lane]) continue;
    RTCRayHit single = rtcGetRayHitFromRayHitN(rays, packet_width, lane);
    intersect(scene, query, single);
    rtcCopyHitToHitN(RTCRayHitN_HitN(rays, packet_width), &single.hit, packet_width, lane);
    packet.rays.ray.tfar[lane] = single.ray.tfar;
  }
}

inline RTCRayHit single_ray(const Ray& ray, double scale, double start) {
  RTCRayHit query{};
  const dvec3 origin = ray.origin * scale + start * ray.direction;
  query.ray.org_x = static_cast<float>(origin.x);
  query.ray.org_y = static_cast<float>(origin.y);
  query.ray.org_z = static_cast<float>(origin.z);
  query.ray.dir_x = direction_component(ray.direction.x);
  query.ray.dir_y = direction_component(ray.direction.y);
  query.ray.dir_z = direction_component(ray.direction.z);
  RTCRay& to = query.ray;
  if (!can_be_traced(to.org_x, to.org_y, to.org_z, to.dir_x, to.dir_y, to.dir_z))
    meet_nothing(to.org_x, to.org_y, to.org_z, to.dir_x, to.dir_y, to.dir_z);
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = 0xffffffffu;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

inline void intersect(RTCScene scene, Query& query, int width, Packet& packet) {
  if (width == 1)
    intersect_singly(scene, query, packet);
  else
    intersect(scene, query, packet.valid.data(), packet.rays);
}

inline void occlude_singly(RTCScene scene, Query& query, double scale, std::span<const Ray> rays) {
  for (unsigned index = 0; index < rays.size(); ++index) {
    RTCRay single = single_ray(rays[index], scale, start_of(rays[index], scale, true)).ray;
    single.id = index;
    occluded(scene, query, single);
  }
}

inline void occlude(RTCScene scene, Query& query, double scale, std::span<const Ray> rays) {
  Packet packet;
  load(packet, rays, scale, true);
  occluded(scene, query, packet.valid.data(), packet.rays.ray);
}

}  // namespace raytube::embree
