#include "plan/ground_paths.h"

namespace raytube {

namespace {

constexpr std::array<GroundPath, 4> paths{{{false, false}, {false, true}, {true, false}, {true, true}}};
constexpr GroundReflection straight{{{1.0, 0.0}, {0.0, 1.0}}};

// Components of spherical_basis are exact on the horizon, too.
Direction mirrored(const Direction& direction) { return {pi - direction.theta, direction.phi}; }

// As SurfaceResponse has it: phi_hat is t, and theta_hat of direction and mirrored direction are d x t and d_r x t.
SurfaceResponse::Polarised ratio_of(const Ground& ground, std::size_t frequency_index, double k, double cosine) {
  if (ground.perfect()) return perfect_conductor.reflected;
  return response(*ground.material, frequency_index, k, cosine, false).reflected;
}

// V = cos theta_hat + sin phi_hat of the ray that goes on, and H across. A conductor makes V of V, and -H of H.
GroundReflection turned(const SurfaceResponse::Polarised& ratio, double c, double s) {
  const Complex mixed = (ratio.tm + ratio.te) * (s * c);
  return {{{ratio.tm * (c * c) - ratio.te * (s * s), mixed}, {-mixed, ratio.te * (c * c) - ratio.tm * (s * s)}}};
}

// Calls action(p, q, from_p, from_q, factor) for whatever adds to an entry.
template <class Action>
void for_each_factor(const GroundReflection& transmit, const GroundReflection& receive, const Action& action) {
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (int from_p = 0; from_p < 2; ++from_p)
        for (int from_q = 0; from_q < 2; ++from_q)
          if (const Complex factor = transmit[from_q][q] * receive[from_p][p]; factor != 0.0)
            action(p, q, from_p, from_q, factor);
}

}  // namespace

std::span<const GroundPath> ground_paths(const Ground& ground) { return std::span(paths).first(ground.perfect() ? 2 : 4); }

std::vector<Look> lighting_looks(const Look& look, const std::optional<Ground>& ground) {
  if (!ground || ground->perfect()) return {look};
  Sweep one;
  one.looks = {look};
  const std::vector<Look> along = sweep_of_paths(one, *ground, false).looks;
  return {along[0], along[2]};
}

Sweep sweep_of_paths(const Sweep& sweep, const Ground& ground, bool rays) {
  Sweep all = sweep;
  all.bistatic = true;
  all.looks.clear();
  for (const Look& look : sweep.looks)
    for (const GroundPath& path : ground_paths(ground)) {
      Look& along = all.looks.emplace_back(look);
      const bool images = rays || !look.far();
      if (path.lit_by_ground) along.transmit = mirrored(look.transmit);
      if (path.seen_by_ground) along.receive = mirrored(look.receive);
      if (path.lit_by_ground && images) along.transmit_mirror = ground.height;
      if (path.seen_by_ground && images) along.receive_mirror = ground.height;
    }
  return all;
}

ScatteringMatrix PathFactors::operator()(const ScatteringMatrix& s) const {
  ScatteringMatrix sum;
  for_each_factor(transmit, receive,
                  [&](int p, int q, int from_p, int from_q, Complex factor) { sum.at(p, q) += factor * s.at(from_p, from_q); });
  return sum;
}

ChannelErrors PathFactors::operator()(const ChannelErrors& errors) const {
  ChannelErrors sum{};
  for_each_factor(transmit, receive, [&](int p, int q, int from_p, int from_q, Complex factor) {
    sum[p][q] += std::abs(factor) * errors[from_p][from_q];
  });
  return sum;
}

GroundReflections::GroundReflections(const Ground& ground, const Sweep& asked, const Sweep& along, const dvec3& middle)
    : ground_(ground), asked_(asked), paths_(along), of_look_(ground_paths(ground)), middle_(middle) {}

GroundReflection GroundReflections::reflection(const Direction& asked, const AntennaPosition& image,
                                               std::size_t frequency_index) const {
  if (!std::isinf(image.range)) return reflection_of_ray(image, frequency_index);
  const double cosine = spherical_basis(asked).radial.z, k = wavenumber(paths_.frequencies[frequency_index]);
  const SurfaceResponse::Polarised ratio = ratio_of(ground_, frequency_index, k, cosine);
  const Complex phase = image.mirror ? 1.0 : std::polar(1.0, 2.0 * k * ground_.height * cosine);
  return {{{ratio.tm * phase, 0.0}, {0.0, ratio.te * phase}}};
}

GroundReflection GroundReflections::reflection_of_ray(const AntennaPosition& image, std::size_t frequency_index) const {
  if (ground_.perfect()) return turned(perfect_conductor.reflected, 1.0, 0.0);
  const dvec3 ray = glm::normalize(middle_ - image.point());
  const SurfaceResponse::Polarised ratio =
      ratio_of(ground_, frequency_index, wavenumber(paths_.frequencies[frequency_index]), ray.z);
  const double across = std::hypot(ray.x, ray.y);
  if (across == 0.0) return turned(ratio, 1.0, 0.0);
  const SphericalBasis basis = spherical_basis(image.direction);
  const dvec3 v = carried(basis.theta_hat, -basis.radial, ray), phi_hat{ray.y / across, -ray.x / across, 0.0};
  return turned(ratio, glm::dot(v, glm::cross(ray, phi_hat)), glm::dot(v, phi_hat));
}

PathFactors GroundReflections::factors(std::size_t look, std::size_t frequency_index) const {
  const GroundPath& way = path(look);
  const Look &along = paths_.looks[look], &asked = asked_.looks[asked_look(look)];
  return {way.lit_by_ground ? reflection(asked.transmit, along.transmitter(), frequency_index) : straight,
          way.seen_by_ground ? reflection(asked.receive, along.receiver(), frequency_index) : straight};
}

}  // namespace raytube
