// Embree 4, or 3.13: what differs between the two stands here, under one name. For tracer.cpp, and the benchmark beside it.
#pragma once

#if RAYTUBE_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace raytube::embree {

#if RAYTUBE_EMBREE == 3
using Context = RTCIntersectContext;  // has the filter
inline void begin(Context& context) { rtcInitIntersectContext(&context); }
constexpr RTCSceneFlags filter_of_queries = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;
#else
struct Context : RTCRayQueryContext {
  RTCFilterFunctionN filter = nullptr;
};
inline void begin(Context& context) { rtcInitRayQueryContext(&context); }
constexpr RTCSceneFlags filter_of_queries = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;
#endif

/// What the rays of a query have in common; `filter`, if any, is asked about each triangle and finds the query as its context.
struct Query : Context {
  Query() { begin(*this); }
};

#if RAYTUBE_EMBREE == 3

inline void intersect(RTCScene scene, Query& query, RTCRayHit& ray) { rtcIntersect1(scene, &query, &ray); }
inline void occluded(RTCScene scene, Query& query, RTCRay& ray) { rtcOccluded1(scene, &query, &ray); }
/// Rays that run side by side.
inline void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit16& rays) {
  query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, scene, &query, &rays);
}
inline void occluded(RTCScene scene, Query& query, const int* valid, RTCRay16& rays) {
  query.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &query, &rays);
}

#else

inline void set_defaults(RTCIntersectArguments& arguments) { rtcInitIntersectArguments(&arguments); }
inline void set_defaults(RTCOccludedArguments& arguments) { rtcInitOccludedArguments(&arguments); }

// Without the second flag Embree takes the filter and never calls it.
template <class Arguments>
Arguments arguments_of(Query& query, RTCRayQueryFlags flags) {
  Arguments arguments;
  set_defaults(arguments);
  arguments.context = &query;
  arguments.filter = query.filter;
  arguments.flags = flags;
#ifndef RAYTUBE_FORGET_FILTER  // defined to see that tests notice it
  if (query.filter) arguments.flags = static_cast<RTCRayQueryFlags>(flags | RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
#endif
  return arguments;
}

inline void intersect(RTCScene scene, Query& query, RTCRayHit& ray) {
  auto arguments = arguments_of<RTCIntersectArguments>(query, RTC_RAY_QUERY_FLAG_INCOHERENT);
  rtcIntersect1(scene, &ray, &arguments);
}
inline void occluded(RTCScene scene, Query& query, RTCRay& ray) {
  auto arguments = arguments_of<RTCOccludedArguments>(query, RTC_RAY_QUERY_FLAG_INCOHERENT);
  rtcOccluded1(scene, &ray, &arguments);
}
/// Rays that run side by side.
inline void intersect(RTCScene scene, Query& query, const int* valid, RTCRayHit16& rays) {
  auto arguments = arguments_of<RTCIntersectArguments>(query, RTC_RAY_QUERY_FLAG_COHERENT);
  rtcIntersect16(valid, scene, &rays, &arguments);
}
inline void occluded(RTCScene scene, Query& query, const int* valid, RTCRay16& rays) {
  auto arguments = arguments_of<RTCOccludedArguments>(query, RTC_RAY_QUERY_FLAG_COHERENT);
  rtcOccluded16(valid, scene, &rays, &arguments);
}

#endif

}  // namespace raytube::embree
