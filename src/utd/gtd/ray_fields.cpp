#include "utd/gtd/ray_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>

#include "core/error.h"
#include "scene/material.h"
#include "utd/wedge/diffracted_field.h"

namespace raytube {

namespace {

constexpr double on_boundary = 1e-12;  // [rad] as in edge_wave_terms: there the edge's wave counts nothing
constexpr double grazing = 1e-7;       // [rad]
constexpr double inset = 1e-6;         // of an edge's length: its ends belong to other faces too

// The point of the edge where its rays are tested for obstacles.
dvec3 nearest_point(const StraightEdge& edge, const EdgeRay& ray) {
  const double margin = inset * (edge.end - edge.begin);
  return edge.origin + std::clamp(ray.arc_length, edge.begin + margin, edge.end - margin) * edge.tangent();
}

// The mean of both sides of a face that the ray runs along exactly.
double side_weight(double n, double angle) {
  if (angle > grazing && angle < n * pi - grazing) return 1.0;
  return n == 2.0 ? 0.0 : 0.5;
}

// Of the target from the origin of the mesh's own coordinates, or a little more [m].
double reach(const TriangleMesh& mesh) { return glm::length(mesh.center) + mesh.radius; }

bool on_half_turn(double angle) { return std::abs(angle - pi) < on_boundary; }

}  // namespace

// One look: what arrives, times both ranges and e^{jk (their sum)}.
class RayFields::Sum {
 public:
  Sum(const RayFields& scene, const Look& look, std::span<const double> frequencies) : scene_(scene), frequencies_(frequencies) {
    const SphericalBasis transmit = spherical_basis(look.transmit), receive = spherical_basis(look.receive);
    const dvec3 center = scene.tracer_.mesh().center;
    transmit_range_ = look.far() ? scene.range_ : look.transmit_range;
    receive_range_ = look.far() ? scene.range_ : look.receive_range;
    transmitter_ = look.transmitter().reference() + transmit_range_ * transmit.radial - center;
    receiver_ = look.receiver().reference() + receive_range_ * receive.radial - center;
    monostatic_ = transmitter_ == receiver_;
    moments_ = {transmit.theta_hat, transmit.phi_hat};
    receive_ = {receive.theta_hat, receive.phi_hat};
    if (look.far())
      to_center_ = -glm::dot(transmit.radial + receive.radial, center);
    else
      antennas_.emplace(look, scene.radar_, center);
    result_.edges.resize(frequencies.size());
    for (const double f : frequencies) wavenumbers_.push_back(wavenumber(f));
  }

  RayLookResult run() {
    for (const Wedge& wedge : scene_.wedges_)
      if (wedge.convex() && !wedge.enclosed && wedge.conducting()) add_edge(wedge);
    add_shadow();
    const MirrorPathList list = scene_.mirrors_.find(transmitter_, receiver_, scene_.most_bounces_, boundary_patches_);
    for (const MirrorPath& path : list.paths) add_mirrors(path);
    result_.rays += list.rays;
    result_.cut = list.cut;
    return std::move(result_);
  }

 private:
  RaySource source(const dvec3& moment) const { return {Spreading::point, transmitter_, {}, {moment, dvec3(0.0)}}; }

  // What an antenna has towards a point, without spreading.
  static std::array<dvec3, 2> fields_towards(const Antenna& antenna, const dvec3& point) {
    std::array<dvec3, 2> fields = antenna.ray_to(point).field;
    for (dvec3& field : fields) field *= glm::distance(point, antenna.position()) / antenna.range();
    return fields;
  }
  std::array<dvec3, 2> moments_towards(const dvec3& point) const {
    return antennas_ ? fields_towards(antennas_->transmit, point) : moments_;
  }
  std::array<dvec3, 2> receive_from(const dvec3& point) const {
    return antennas_ ? fields_towards(antennas_->receive, point) : receive_;
  }

  Complex reference(double k) const { return std::polar(1.0, k * to_center_); }

  void add_edge(const Wedge& wedge) {
    const StraightEdge edge = straight_edge(wedge);
    if (!has_edge_ray(edge, source(moments_[0]), receiver_)) return;
    EdgeRay ray = edge_ray(edge, source(moments_[0]), receiver_);
    const double weight = weight_of(edge, ray);
    const dvec3 nearest = nearest_point(edge, ray);
    if (weight == 0.0 || !is_clear(wedge, nearest)) return;
    note_boundaries(wedge, edge, ray);
    ++result_.edge_rays;
    ray.path -= transmit_range_ + receive_range_;
    ray.spread *= weight * transmit_range_ * receive_range_;
    const std::array<dvec3, 2> moments = moments_towards(nearest), received = receive_from(nearest);
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      for (const int transmit : {0, 1}) {
        const ComplexVector field = diffracted_field(edge, ray, source(moments[transmit]).moment, wavenumbers_[f]);
        for (const int receive : {0, 1})
          result_.edges[f].at(receive, transmit) += reference(wavenumbers_[f]) * dot(field, received[receive]);
      }
  }

  double weight_of(const StraightEdge& edge, const EdgeRay& ray) const {
    const double source = side_weight(edge.n, ray.source_angle), observer = side_weight(edge.n, ray.observation_angle);
    return monostatic_ ? std::min(source, observer) : source * observer;
  }

  bool is_clear(const Wedge& wedge, const dvec3& point) {
    result_.rays += 2;
    const IgnoredPatches own{wedge.faces[0].patch, wedge.faces[1].patch, no_index};
    return has_line_of_sight(scene_.tracer_, point, transmitter_, own) &&
           has_line_of_sight(scene_.tracer_, point, receiver_, own);
  }

  // Whose shadow or reflection boundary is in this ray.
  void note_boundaries(const Wedge& wedge, const StraightEdge& edge, const EdgeRay& ray) {
    const double room = on_boundary * transmit_range_;
    if (ray.arc_length < edge.begin - room || ray.arc_length > edge.end + room) return;
    if (on_half_turn(std::abs(ray.observation_angle - ray.source_angle))) ++edges_in_direct_ray_;
    const double sum = ray.observation_angle + ray.source_angle;
    if (on_half_turn(sum)) boundary_patches_.push_back(wedge.faces[0].patch);
    if (on_half_turn(2 * edge.n * pi - sum)) boundary_patches_.push_back(wedge.faces[1].patch);
  }

  // The direct ray less itself.
  void add_shadow() {
    if (monostatic_ || !target_may_stand_between()) return;
    if (edges_in_direct_ray_ == 0 && !blocks_between(scene_.tracer_, transmitter_, receiver_)) return;
    add_ray(0, glm::length(receiver_ - transmitter_), transmitter_, moments_towards(receiver_),
            -std::ldexp(1.0, -edges_in_direct_ray_));
  }

  // An antenna at a finite distance has all of the target in front, and nothing of it beside or behind.
  bool target_may_stand_between() const {
    if (!antennas_) return true;
    const dvec3 way = receiver_ - transmitter_;
    return glm::dot(way, antennas_->transmit.radial()) < 0.0 && glm::dot(way, antennas_->receive.radial()) > 0.0;
  }

  void add_mirrors(const MirrorPath& path) {
    dvec3 image = transmitter_;
    for (const std::uint32_t patch : path.patches) {
      const Patch& plane = scene_.tracer_.mesh().patches[patch];
      image -= 2.0 * (glm::dot(plane.normal, image) - plane.offset) * plane.normal;
    }
    dvec3 leaving = receiver_ - image;
    for (const std::uint32_t patch : path.patches | std::views::reverse)
      leaving = reflected_direction(leaving, scene_.tracer_.mesh().patches[patch].normal);
    std::array<dvec3, 2> moments = moments_towards(transmitter_ + leaving);
    for (const std::uint32_t patch : path.patches)
      for (dvec3& moment : moments) moment = reflected_field_pec(moment, scene_.tracer_.mesh().patches[patch].normal);
    const std::size_t bounce = path.patches.size() - 1;
    const auto edges = bounce == 0 ? std::ranges::count(boundary_patches_, path.patches[0]) : 0;
    if (result_.paths.size() <= bounce) result_.paths.resize(bounce + 1);
    ++result_.paths[bounce];
    add_ray(bounce, path.length, image, moments, std::ldexp(1.0, -static_cast<int>(edges)));
  }

  void add_ray(std::size_t bounce, double length, const dvec3& from, const std::array<dvec3, 2>& moments, double weight) {
    if (result_.bounces.size() <= bounce) result_.bounces.resize(bounce + 1, std::vector<ScatteringMatrix>(frequencies_.size()));
    const dvec3 direction = (receiver_ - from) / length;
    const double spread = weight * transmit_range_ * receive_range_ / length;
    const std::array<dvec3, 2> received = receive_from(from);
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const Complex phase =
          std::polar(spread, -wavenumbers_[f] * (length - (transmit_range_ + receive_range_))) * reference(wavenumbers_[f]);
      for (const int transmit : {0, 1}) {
        const dvec3 field = moments[transmit] - glm::dot(moments[transmit], direction) * direction;
        for (const int receive : {0, 1})
          result_.bounces[bounce][f].at(receive, transmit) += phase * glm::dot(field, received[receive]);
      }
    }
  }

  const RayFields& scene_;
  std::span<const double> frequencies_;
  std::vector<double> wavenumbers_;
  double transmit_range_, receive_range_;
  dvec3 transmitter_, receiver_;
  std::optional<AntennaPair> antennas_;     // at a finite distance
  std::array<dvec3, 2> moments_, receive_;  // V, H
  bool monostatic_ = false;
  double to_center_ = 0.0;
  int edges_in_direct_ray_ = 0;
  std::vector<std::uint32_t> boundary_patches_;  // patches whose reflected light ends in the ray, once for each edge
  RayLookResult result_;
};

RayFields::RayFields(const Tracer& tracer, std::span<const Wedge> wedges, double range, const Radar& radar, int most_bounces)
    : tracer_(tracer), wedges_(wedges), mirrors_(tracer), range_(range), radar_(radar), most_bounces_(most_bounces) {}

RayLookResult RayFields::look(const Look& look, std::span<const double> frequencies) const {
  return Sum(*this, look, frequencies).run();
}

double default_ray_range(const TriangleMesh& mesh, double highest_frequency) {
  const double diameter = 2 * mesh.radius;
  return 10 * std::max(2 * diameter * diameter / wavelength(highest_frequency), reach(mesh));
}

void check_ray_range(const TriangleMesh& mesh, double range) {
  if (range > reach(mesh)) return;
  throw InputError(fmt::format(
      "edges.utd_range_m is {:.6g} m, but the target reaches {:.6g} m from the origin of its coordinates; give more than that",
      range, reach(mesh)));
}

}  // namespace raytube
