#include "gtd/ray_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/error.h"
#include "core/reversed.h"
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
  Sum(const RayFields& scene, const Look& look, std::span<const double> frequencies) : scene_(scene) {
    const SphericalBasis transmit = spherical_basis(look.transmit), receive = spherical_basis(look.receive);
    const dvec3 center = scene.surfaces_.mesh().center;
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
    for (std::size_t f = 0; f < frequencies.size(); ++f) at_.push_back({f, wavenumber(frequencies[f])});
  }

  RayLookResult run() {
    for (const Wedge& wedge : scene_.wedges_)
      if (wedge.convex() && !wedge.enclosed && wedge.conducting()) add_edge(wedge);
    add_shadow();
    std::vector<std::uint32_t> patches;
    for (const Boundary& boundary : boundaries_) patches.push_back(boundary.patch);
    const MirrorPathList list = scene_.mirrors_.find(transmitter_, receiver_, scene_.most_bounces_, patches);
    for (const MirrorPath& path : list.paths) add_mirrors(path);
    result_.rays += list.rays;
    result_.cut = list.cut;
    return std::move(result_);
  }

 private:
  using Fields = std::array<ComplexVector, 2>;  // of transmit V and H

  // From where an edge's rays are tested for obstacles, and the sheets on the way there and on.
  struct EdgeSight {
    dvec3 point;
    SheetsPassed before, behind;
  };

  // A patch on whose reflection boundary the look lies, and what is before the edge at which it ends.
  struct Boundary {
    std::uint32_t patch;
    std::vector<SheetsPassed> sheets;  // as in MirrorPath
  };

  RaySource source(const ComplexVector& moment) const { return {Spreading::point, transmitter_, {}, moment}; }

  // What an antenna has towards a point, without spreading.
  static std::array<dvec3, 2> fields_towards(const Antenna& antenna, const dvec3& point) {
    std::array<dvec3, 2> fields = antenna.ray_to(point).field;
    for (dvec3& field : fields) field *= glm::distance(point, antenna.position()) / antenna.range();
    return fields;
  }
  Fields moments_towards(const dvec3& point) const {
    const std::array<dvec3, 2> moments = antennas_ ? fields_towards(antennas_->transmit, point) : moments_;
    return {ComplexVector{moments[0]}, ComplexVector{moments[1]}};
  }
  std::array<dvec3, 2> receive_from(const dvec3& point) const {
    return antennas_ ? fields_towards(antennas_->receive, point) : receive_;
  }

  Complex reference(double k) const { return std::polar(1.0, k * to_center_); }

  void add_edge(const Wedge& wedge) {
    const StraightEdge edge = straight_edge(wedge);
    const RaySource transmitter = source({});
    if (!has_edge_ray(edge, transmitter, receiver_)) return;
    EdgeRay ray = edge_ray(edge, transmitter, receiver_);
    const double weight = weight_of(edge, ray);
    if (weight == 0.0) return;
    const std::optional<EdgeSight> sight = sight_of(wedge, nearest_point(edge, ray));
    if (!sight) return;
    note_boundaries(wedge, edge, ray, *sight);
    ++result_.edge_rays;
    ray.path -= transmit_range_ + receive_range_;
    ray.spread *= weight * transmit_range_ * receive_range_;
    add_diffracted(edge, ray, *sight);
  }

  void add_diffracted(const StraightEdge& edge, const EdgeRay& ray, const EdgeSight& sight) {
    const dvec3 arriving = glm::normalize(sight.point - transmitter_), leaving = glm::normalize(receiver_ - sight.point);
    const std::array<dvec3, 2> received = receive_from(sight.point);
    for (const RayFrequency& at : at_) {
      Fields fields = moments_towards(sight.point);
      scene_.surfaces_.pass(sight.before, at, arriving, fields);
      for (ComplexVector& field : fields) field = diffracted_field(edge, ray, field, at.wavenumber);
      scene_.surfaces_.pass(sight.behind, at, leaving, fields);
      for (const int transmit : {0, 1})
        for (const int receive : {0, 1})
          result_.edges[at.index].at(receive, transmit) += reference(at.wavenumber) * dot(fields[transmit], received[receive]);
    }
  }

  double weight_of(const StraightEdge& edge, const EdgeRay& ray) const {
    const double source = side_weight(edge.n, ray.source_angle), observer = side_weight(edge.n, ray.observation_angle);
    return monostatic_ ? std::min(source, observer) : source * observer;
  }

  std::optional<EdgeSight> sight_of(const Wedge& wedge, const dvec3& point) {
    result_.rays += 2;
    const IgnoredPatches own{wedge.faces[0].patch, wedge.faces[1].patch, no_index};
    std::optional<SheetsPassed> in = scene_.surfaces_.outwards(point, transmitter_, own);
    if (!in) return std::nullopt;
    std::optional<SheetsPassed> out = scene_.surfaces_.outwards(point, receiver_, own);
    if (!out) return std::nullopt;
    std::ranges::reverse(*in);
    return EdgeSight{point, std::move(*in), std::move(*out)};
  }

  // Whose shadow or reflection boundary is in this ray.
  void note_boundaries(const Wedge& wedge, const StraightEdge& edge, const EdgeRay& ray, const EdgeSight& sight) {
    const double room = on_boundary * transmit_range_;
    if (ray.arc_length < edge.begin - room || ray.arc_length > edge.end + room) return;
    if (on_half_turn(std::abs(ray.observation_angle - ray.source_angle))) in_direct_ray_.push_back(sight);
    const double sum = ray.observation_angle + ray.source_angle;
    const auto note = [&](const WedgeFace& face) { boundaries_.push_back({face.patch, {sight.before, sight.behind}}); };
    if (on_half_turn(sum)) note(wedge.faces[0]);
    if (on_half_turn(2 * edge.n * pi - sum)) note(wedge.faces[1]);
  }

  // The direct ray less itself, and what comes through sheets in its place.
  void add_shadow() {
    if (monostatic_ || !target_may_stand_between()) return;
    const std::optional<SheetsPassed> sheets = sheets_in_direct_ray();
    const double hidden = !sheets                  ? 1.0
                          : in_direct_ray_.empty() ? 0.0
                                                   : std::ldexp(1.0, -static_cast<int>(in_direct_ray_.size()));
    const bool screened = sheets && !sheets->empty();
    if (hidden == 0.0 && !screened) return;
    const dvec3 way = receiver_ - transmitter_;
    const Fields plain = moments_towards(receiver_);
    add_ray(0, glm::length(way), transmitter_, screened ? -1.0 : -hidden, [&](const RayFrequency&) { return plain; });
    if (!screened) return;
    add_ray(0, glm::length(way), transmitter_, 1.0 - hidden, [&](const RayFrequency& at) {
      Fields fields = plain;
      scene_.surfaces_.pass(*sheets, at, glm::normalize(way), fields);
      return fields;
    });
  }

  // None if something opaque is in the ray.
  std::optional<SheetsPassed> sheets_in_direct_ray() const {
    if (in_direct_ray_.empty()) return scene_.surfaces_.past_target(transmitter_, receiver_);
    SheetsPassed sheets = in_direct_ray_.front().before;
    std::ranges::copy(in_direct_ray_.front().behind, std::back_inserter(sheets));
    return sheets;
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
      const Patch& plane = scene_.surfaces_.patch(patch);
      image -= 2.0 * (glm::dot(plane.normal, image) - plane.offset) * plane.normal;
    }
    dvec3 leaving = receiver_ - image;
    for (const std::uint32_t patch : reversed(path.patches))
      leaving = reflected_direction(leaving, scene_.surfaces_.patch(patch).normal);
    const Fields moments = moments_towards(transmitter_ + leaving);
    const std::size_t bounce = path.patches.size() - 1;
    const auto edges = bounce == 0 ? std::ranges::count(boundaries_, path.patches[0], &Boundary::patch) : 0;
    const std::vector<SheetsPassed>& sheets =
        edges > 0 ? std::ranges::find(boundaries_, path.patches[0], &Boundary::patch)->sheets : path.sheets;
    if (result_.paths.size() <= bounce) result_.paths.resize(bounce + 1);
    ++result_.paths[bounce];
    add_ray(bounce, path.length, image, std::ldexp(1.0, -static_cast<int>(edges)),
            [&](const RayFrequency& at) { return after_mirrors(path, sheets, glm::normalize(leaving), at, moments); });
  }

  Fields after_mirrors(const MirrorPath& path, std::span<const SheetsPassed> sheets, dvec3 direction, const RayFrequency& at,
                       Fields fields) const {
    for (std::size_t i = 0; i < path.patches.size(); ++i) {
      scene_.surfaces_.pass(sheets[i], at, direction, fields);
      scene_.surfaces_.reflect(path.patches[i], at, direction, fields);
      direction = reflected_direction(direction, scene_.surfaces_.patch(path.patches[i]).normal);
    }
    scene_.surfaces_.pass(sheets.back(), at, direction, fields);
    return fields;
  }

  // `fields_at`(frequency) is what arrives, without spreading and phase.
  template <class FieldsAt>
  void add_ray(std::size_t bounce, double length, const dvec3& from, double weight, FieldsAt fields_at) {
    if (result_.bounces.size() <= bounce) result_.bounces.resize(bounce + 1, std::vector<ScatteringMatrix>(at_.size()));
    const dvec3 direction = (receiver_ - from) / length;
    const double spread = weight * transmit_range_ * receive_range_ / length;
    const std::array<dvec3, 2> received = receive_from(from);
    for (const RayFrequency& at : at_) {
      const double k = at.wavenumber;
      const Complex phase = std::polar(spread, -k * (length - (transmit_range_ + receive_range_))) * reference(k);
      const Fields fields = fields_at(at);
      for (const int transmit : {0, 1})
        for (const int receive : {0, 1})
          result_.bounces[bounce][at.index].at(receive, transmit) +=
              phase * dot(across(fields[transmit], direction), received[receive]);
    }
  }

  const RayFields& scene_;
  std::vector<RayFrequency> at_;
  double transmit_range_, receive_range_;
  dvec3 transmitter_, receiver_;
  std::optional<AntennaPair> antennas_;     // at a finite distance
  std::array<dvec3, 2> moments_, receive_;  // V, H
  bool monostatic_ = false;
  double to_center_ = 0.0;
  std::vector<EdgeSight> in_direct_ray_;  // edges
  std::vector<Boundary> boundaries_;      // where reflected light ends in the ray, once for each edge
  RayLookResult result_;
};

RayFields::RayFields(const Tracer& tracer, std::span<const Material> materials, std::span<const Wedge> wedges, double range,
                     const Radar& radar, int most_bounces)
    : surfaces_(tracer, materials),
      wedges_(wedges),
      mirrors_(surfaces_),
      range_(range),
      radar_(radar),
      most_bounces_(most_bounces) {}

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
