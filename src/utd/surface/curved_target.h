// What all looks at the curved surfaces of a target share.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/smooth/curvature_field.h"
#include "mesh/trace/tracer.h"
#include "scene/frequency_bands.h"
#include "utd/fock/face_impedances.h"
#include "utd/surface/body_widths.h"
#include "utd/surface/noses.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

/// The least curvature of a surface, times the target's radius, that bends waves: over a flatter one they go straight on.
inline constexpr double flattest_curvature = 1e-6;

struct CurvedTarget {
  /// Keeps references to the first two and the materials. `is_convex`: nothing stands in the light of a surface that is turned
  /// to it. `some_materials` are those of the mesh, at `frequencies`; `rounded_edges`, if wanted, are those at the lowest of
  /// these and above, none without any.
  CurvedTarget(const Tracer& a_tracer, const SmoothSurfaces& some_surfaces, bool is_convex,
               std::span<const Material> some_materials = {}, std::span<const double> frequencies = {}, bool rounded_edges = true)
      : tracer(a_tracer),
        surfaces(some_surfaces),
        curvatures(tracer.mesh(), surfaces),
        widths(body_widths(tracer.mesh())),
        materials(some_materials),
        impedances(materials, frequencies),
        lowest(lowest_wavenumber(frequencies)),
        noses(rounded_edges ? find_noses(tracer.mesh(), surfaces, curvatures, lowest) : std::vector<Nose>()),
        convex(is_convex) {}

  /// At barycentric coordinates of a triangle, seen from one of its sides: 1 its front, -1 its back.
  SurfaceFrame frame(std::uint32_t triangle, const dvec2& l, double side) const { return curvatures.at(triangle, l).from(side); }

  /// What a body keeps of waves over it for its width.
  double width_share(std::uint32_t component, double wavenumber) const { return share_of_width(widths[component] * wavenumber); }

  /// Whether a body is wide enough for waves to run over it at a wavenumber.
  bool is_wide(std::uint32_t component, double wavenumber) const { return width_share(component, wavenumber) > 0.0; }

  /// The material of a facet; no_index: a perfect conductor.
  std::uint32_t material(std::uint32_t triangle) const { return tracer.mesh().patch_of(triangle).material; }

  /// Whether a facet is part of a surface over which waves run at all.
  bool carries_waves(std::uint32_t triangle) const {
    return surfaces.region(triangle) != no_index && raytube::carries_waves(materials, material(triangle));
  }

  /// Whether they run over it at this wavenumber.
  bool runs_over(std::uint32_t triangle, double wavenumber) const {
    return carries_waves(triangle) && is_wide(tracer.mesh().triangle_component[triangle], wavenumber);
  }

  /// What a facet keeps of waves over it: less than 1 where they cross a rounded edge, which has the rest.
  double wave_share(std::uint32_t triangle, const dvec3& incident, const dvec3& scattered, double wavenumber) const {
    const auto nose = std::ranges::lower_bound(noses, triangle, {}, &Nose::triangle);
    if (nose == noses.end() || nose->triangle != triangle) return 1.0;
    const double sine = std::sqrt(nose->sine_to(incident) * nose->sine_to(scattered));
    return 1.0 - nose->edge_share(incident, scattered, wavenumber) * nose->facet_share(wavenumber, sine);
  }

  /// Whether currents are analytic in the wavenumber, so that few frequencies stand for many: shares of rounded edges have kinks,
  /// and impedances are known at the frequencies of the look alone.
  bool is_analytic() const { return noses.empty() && materials.empty(); }

  std::vector<Nose> short_noses(double longest) const {
    return noses_in_parts(tracer.mesh(), surfaces, curvatures, lowest, noses, longest);
  }

  const dvec3& corner(std::uint32_t triangle, int corner) const {
    return tracer.mesh().vertices[tracer.mesh().triangles[triangle][corner]];
  }

  /// n . d at a corner of a triangle, where rounding is none.
  double facing(std::uint32_t triangle, int corner, const dvec3& incident_direction) const {
    const double f = glm::dot(curvatures.normal(triangle, corner), incident_direction);
    return std::abs(f) < rounding_guard ? 0.0 : f;
  }

  /// Whether light comes to a point of a surface with that normal.
  bool is_lit(const dvec3& position, const dvec3& normal, const dvec3& incident_direction) const {
    if (convex) return true;
    const double lift = 2.0 * surfaces.rise() + 1e-6 * tracer.mesh().radius;
    return tracer.blocker(position + lift * normal, -incident_direction, nothing_ignored) == no_index;
  }

  static double lowest_wavenumber(std::span<const double> frequencies) {
    return frequencies.empty() ? std::numeric_limits<double>::infinity() : wavenumber(least_frequency(frequencies));
  }

  const Tracer& tracer;
  const SmoothSurfaces& surfaces;
  const CurvatureField curvatures;
  const std::vector<double> widths;  // [component], in metres
  const std::span<const Material> materials;
  const FaceImpedances impedances;
  const double lowest;            // wavenumber
  const std::vector<Nose> noses;  // in order of triangles
  const bool convex;
};

}  // namespace raytube
