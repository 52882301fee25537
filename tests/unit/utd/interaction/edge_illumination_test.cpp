// Edge-diffracted illumination of other faces against quadrature over these faces, point by point.
#include "utd/interaction/edge_illumination.h"

#include <gtest/gtest.h>

#include <optional>

#include "math/erfc_ray.h"
#include "math/gauss.h"
#include "run.h"
#include "unit/utd_scene.h"

namespace raytube {
namespace {

using testing::measured;

constexpr double k = 2 * pi;  // wavelength 1 m

using Vector = std::array<Complex, 3>;

/// A parallelogram: center +- a +- b.
struct Panel {
  dvec3 center, a, b;
  dvec3 normal() const { return glm::normalize(glm::cross(a, b)); }
  dvec3 image(const dvec3& point) const { return point - 2 * glm::dot(point - center, normal()) * normal(); }
};

enum class Ends { shared, cut };

/// A half plane in z = 0 whose edge runs along y; its diffracted field as a function of the point.
class HalfPlane {
 public:
  HalfPlane(double half_length, const dvec3& incident, Ends ends) : half_length_(half_length), ends_(ends), incident_(incident) {
    cos_cone_ = incident.y;
    sin_cone_ = std::hypot(incident.x, incident.z);
    source_ = azimuth({-incident.x, 0, -incident.z});
  }

  /// phi from the face at x < 0 through z > 0.
  static double azimuth(const dvec3& point) {
    const double angle = std::atan2(point.z, -point.x);
    return angle < 0.0 ? angle + 2 * pi : angle;
  }

  dvec3 ray(const dvec3& point) const {
    return sin_cone_ * glm::normalize(dvec3(point.x, 0, point.z)) + cos_cone_ * dvec3(0, 1, 0);
  }

  /// eta H of the diffracted wave of unit E and eta H along the edge times those given: Maxwell's equations for fields that go as
  /// e^{-jk cos(beta0) y}, the factors of the corners taken as constants.
  Vector magnetic(const dvec3& point, double electric_along, double magnetic_along) const {
    const double rho = std::hypot(point.x, point.z), phi = azimuth(point), transverse = k * sin_cone_;
    Complex u = 0.0, soft_out = 0.0, soft_round = 0.0, hard_out = 0.0, hard_round = 0.0;
    for (const double sign : {-1.0, 1.0}) {
      const double psi = phi + sign * source_, step = 1e-4;
      const Complex factor = corner(point, rho, psi);
      const auto slope = [&](double out, double turn) {
        const auto at = [&](double h) { return wave(rho + out * h, psi + turn * h); };
        return factor * (8.0 * (at(step) - at(-step)) - (at(2 * step) - at(-2 * step))) / (12 * step);
      };
      const Complex out = slope(1, 0), round = slope(0, 1) / rho;
      u += factor * wave(rho, psi);  // of E along the edge sum - difference below
      const double soft = sign < 0 ? 1.0 : -1.0;
      soft_out += soft * electric_along * out;
      soft_round += soft * electric_along * round;
      hard_out += magnetic_along * out;
      hard_round += magnetic_along * round;
    }
    u *= magnetic_along;
    // t = y, rho_hat and phi_hat = t x rho_hat; eta H_t = (j / k_t^2) [-k t x grad E_t - k cos(beta0) grad eta H_t].
    const dvec3 t(0, 1, 0), across = dvec3(point.x, 0, point.z) / rho, turning = glm::cross(t, across);
    const Complex scale = Complex(0, k) / (transverse * transverse);
    const Complex along_across = scale * (soft_round - cos_cone_ * hard_out);
    const Complex along_turning = scale * (-soft_out - cos_cone_ * hard_round);
    const Complex phase = std::polar(1.0, -k * cos_cone_ * point.y);
    Vector field;
    for (int i = 0; i < 3; ++i) field[i] = phase * (u * t[i] + along_across * across[i] + along_turning * turning[i]);
    return field;
  }

 private:
  /// Sommerfeld (1896): half the ray's amplitude on the boundary, none of it in the light.
  Complex wave(double rho, double psi) const {
    const double c = std::cos(psi / 2);
    return std::copysign(0.5, -c) * std::polar(1.0, -k * rho * sin_cone_) *
           scaled_erfc(std::sqrt(2 * k * rho * sin_cone_) * std::abs(c));
  }

  Complex corner(const dvec3& point, double rho, double psi) const {
    const double s = rho / sin_cone_, position = point.y - s * cos_cone_;
    if (ends_ == Ends::cut) return std::abs(position) < half_length_ ? 1.0 : 0.0;
    const double c = std::cos(psi / 2), z2 = 2 * k * rho * sin_cone_ * c * c;
    Complex factor = -1.0;
    for (const double end : {-1.0, 1.0}) {
      const double corner = end * half_length_;
      const bool inside = end * position < half_length_;
      const double over = corner * cos_cone_ + std::hypot(rho, point.y - corner);
      const double x2 = k * std::max(over - (position * cos_cone_ + s), 0.0);
      const Complex step = std::polar(0.5, -x2) * scaled_erfc(std::sqrt(x2)) * z2 / (z2 + x2);
      factor += inside ? 1.0 - step : step;
    }
    return factor;
  }

  double half_length_;
  Ends ends_;
  dvec3 incident_;
  double cos_cone_, sin_cone_, source_;
};

/// A sum over points, and of their magnitudes, of which quadrature leaves a share.
struct PointSum {
  ScatteringMatrix value;
  double size = 0.0;
};

class Setting {
 public:
  /// All panels are perfect conductors, or a half-space of this medium.
  Setting(double half_length, std::vector<Panel> panels, std::optional<Medium> medium = {})
      : half_length_(half_length), panels_(std::move(panels)), medium_(medium) {
    const std::uint32_t own = test::add_panel(scene_.mesh, {-1, 0, 0}, {1, 0, 0}, {0, half_length, 0});
    for (const Panel& panel : panels_) {
      const std::uint32_t patch = test::add_panel(scene_.mesh, panel.center, panel.a, panel.b);
      if (medium_) scene_.mesh.patches[patch].material = 0;
    }
    if (medium_) materials_ = {{"medium", MaterialKind::half_space, 0.0, {{{*medium_, 0.0}}}}};
    const dvec3 end(0, half_length, 0);
    scene_.wedges = {test::half_plane(-end, end, {-1, 0, 0}, {0, 0, 1}, 2.0, own)};
    axis_ = {&scene_.wedges[0], -end, {0, 1, 0}, 2 * half_length, {}};
  }

  ScatteringMatrix illuminated(const LookVectors& look, int reflections) const {
    const PlaneWave wave{look.incident, look.electric, 0.0};
    const WedgeIncidence incidence = incidence_on(scene_.wedges[0], look.incident);
    const LitEdgePiece source{&axis_, &wave, incidence.faces[0], 0.0, axis_.length, 1.0};
    const FaceTree tree(scene_.mesh);
    const double wavenumbers[] = {k};
    const std::vector<bool> all(scene_.mesh.patches.size(), true);
    const std::size_t indices[] = {0};
    EdgeIllumination illumination({tree, all, {}, {}, {materials_, indices}}, look, wavenumbers, source, reflections);
    const std::vector<double> cuts = this->cuts();
    std::vector<ScatteringMatrix> density;
    ScatteringMatrix sum;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      const double width = cuts[i] - cuts[i - 1];
      const int parts = 1 + static_cast<int>(width / 0.05);
      for (int part = 0; part < parts; ++part)
        for (const GaussPoint& point : gauss_rule(24)) {
          illumination.at(cuts[i - 1] + width * (part + point.node) / parts, density);
          sum += density[0] *= point.weight * width / parts;
        }
    }
    return sum;
  }

  PointSum by_points(const LookVectors& look, bool mirrored, Ends ends) const {
    const HalfPlane edge(half_length_, look.incident, ends);
    PointSum sum;
    for (const Panel& target : panels_) {
      add(look, edge, target, nullptr, sum);
      for (const Panel& mirror : panels_)
        if (mirrored && &mirror != &target) add(look, edge, target, &mirror, sum);
    }
    return sum;
  }

 private:
  // The azimuths of all corners, and of their images.
  std::vector<double> cuts() const {
    std::vector<double> cuts = {0.0, 2 * pi};
    for (const Panel& panel : panels_)
      for (const dvec3& corner : {panel.center - panel.a - panel.b, panel.center - panel.a + panel.b,
                                  panel.center + panel.a - panel.b, panel.center + panel.a + panel.b}) {
        cuts.push_back(HalfPlane::azimuth(corner));
        for (const Panel& mirror : panels_) cuts.push_back(HalfPlane::azimuth(mirror.image(corner)));
      }
    std::ranges::sort(cuts);
    return cuts;
  }

  static bool passes(const dvec3& from, const dvec3& to, const Panel& panel) {
    const dvec3 n = panel.normal();
    const double before = glm::dot(from - panel.center, n), after = glm::dot(to - panel.center, n);
    if (before * after >= 0.0) return false;
    const dvec3 hit = from + before / (before - after) * (to - from) - panel.center;
    return std::abs(glm::dot(hit, panel.a)) <= glm::dot(panel.a, panel.a) &&
           std::abs(glm::dot(hit, panel.b)) <= glm::dot(panel.b, panel.b);
  }

  // J = 2 n x H at every point, n towards where the ray comes from, radiating in free space (Stratton & Chu 1939).
  void add(const LookVectors& look, const HalfPlane& edge, const Panel& target, const Panel* mirror, PointSum& sum) const {
    constexpr int panels = 8;
    for (int iu = 0; iu < panels; ++iu)
      for (int iv = 0; iv < panels; ++iv)
        for (const GaussPoint& u : gauss_rule(12))
          for (const GaussPoint& v : gauss_rule(12)) {
            const dvec3 r =
                target.center + (2 * (iu + u.node) / panels - 1) * target.a + (2 * (iv + v.node) / panels - 1) * target.b;
            const double area = 4 * glm::length(glm::cross(target.a, target.b)) * u.weight * v.weight / (panels * panels);
            add(look, edge, r, target.normal(), area, mirror, sum);
          }
  }

  void add(const LookVectors& look, const HalfPlane& edge, const dvec3& r, const dvec3& plane, double area, const Panel* mirror,
           PointSum& sum) const {
    const dvec3 unfolded = mirror ? mirror->image(r) : r;
    dvec3 ray = edge.ray(unfolded);
    if (mirror) {
      const double way = std::hypot(unfolded.x, unfolded.z) / std::hypot(look.incident.x, look.incident.z);
      if (!passes(unfolded - way * ray, unfolded, *mirror)) return;
      ray -= 2 * glm::dot(ray, mirror->normal()) * mirror->normal();
    }
    const dvec3 n = glm::dot(plane, ray) > 0.0 ? -plane : plane;
    for (int q = 0; q < 2; ++q) {
      const dvec3 t(0, 1, 0), magnetic = glm::cross(look.incident, look.electric[q]);
      Vector h = edge.magnetic(unfolded, glm::dot(look.electric[q], t), glm::dot(magnetic, t));
      if (mirror) {
        const dvec3 before = edge.ray(unfolded), m = mirror->normal();
        h = reflected(h, before, glm::dot(m, before) > 0.0 ? -m : m);
      }
      const Vector back = reflected(h, ray, n);
      const Complex factor = Complex(0, -k / (4 * pi)) * std::polar(area, k * glm::dot(look.scattered, r));
      const Vector e = both(electric(h, ray), electric(back, ray - 2 * glm::dot(ray, n) * n));
      const Vector eta_j = times(n, both(h, back)), m = times(-n, e);
      for (int p = 0; p < 2; ++p)
        for (int i = 0; i < 3; ++i)
          sum.value.at(p, q) += factor * (look.receive[p][i] * eta_j[i] + glm::cross(look.scattered, look.receive[p])[i] * m[i]);
      for (int i = 0; i < 3; ++i) sum.size += std::abs(factor * eta_j[i]);
    }
  }

  static Vector times(const dvec3& a, const Vector& b) {
    return {a.y * b[2] - a.z * b[1], a.z * b[0] - a.x * b[2], a.x * b[1] - a.y * b[0]};
  }
  static Vector both(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
  static Complex along(const Vector& v, const dvec3& axis) { return v[0] * axis.x + v[1] * axis.y + v[2] * axis.z; }
  // E of the part of a ray's wave that is across it.
  static Vector electric(const Vector& h, const dvec3& ray) { return times(-ray, h); }

  // eta H after a reflection: the part with H in the plane of incidence by the coefficient of E across that plane, the part
  // across it by the coefficient of H there (Fresnel; Balanis 2012, section 5.3).
  Vector reflected(const Vector& h, const dvec3& ray, const dvec3& n) const {
    const double cosine = -glm::dot(ray, n), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    Complex across_e = -1.0, across_h = 1.0;
    if (medium_) {
      const Complex eps = medium_->permittivity, root = std::sqrt(eps - sine * sine);
      across_e = (cosine - root) / (cosine + root);
      across_h = (eps * cosine - root) / (eps * cosine + root);
    }
    const dvec3 side = glm::normalize(glm::cross(ray, n)), back = ray + 2 * cosine * n;
    const dvec3 in_plane = glm::cross(ray, side), in_plane_back = glm::cross(back, side);
    Vector result{};
    for (int i = 0; i < 3; ++i)
      result[i] = across_h * along(h, side) * side[i] + across_e * along(h, in_plane) * in_plane_back[i] -
                  across_e * along(h, ray) * back[i];
    return result;
  }

  double half_length_;
  std::vector<Panel> panels_;
  std::optional<Medium> medium_;
  std::vector<Material> materials_;
  test::Scene scene_;
  EdgeAxis axis_;
};

/// From an azimuth about the edge and a height along it. No shadow or reflection boundary of these meets a face below, where a
/// sum over points would find its jump too slowly.
Look look_from(double azimuth_deg, double along, const Direction& receive) {
  const double across = std::sqrt(1 - along * along), azimuth = azimuth_deg * degree;
  const dvec3 r(-across * std::cos(azimuth), along, across * std::sin(azimuth));
  return {{std::acos(r.z), std::atan2(r.y, r.x)}, receive};
}

const Look looks[] = {look_from(85, 0.3, {1.1, 0.8}), look_from(110, -0.4, {2.0, 2.4}), look_from(150, 0.2, {0.8, -2.2}),
                      look_from(235, 0.35, {1.0, 0.3})};

// What comes from `above` misses `right`; all paths from `above` over the mirror `right` is inside it.
const Panel above{{1.0, 0.2, 4}, {0.5, 0, 0}, {0, 1.3, 0}}, right{{3, 0, 2.45}, {0, 0, 0.45}, {0, 6, 0}};
const Panel oblique{{2.0, 0.4, -1.0}, {0.5, 0.3, 1.0}, {0.4, 1.2, -0.56}};

double relative(const ScatteringMatrix& found, const PointSum& wanted) {
  return frobenius_norm(found - wanted.value) / wanted.size;
}

// Eight points for every run of distances up to a ratio of eight leave below 1e-4 of a wave; ends 60 wavelengths away count for
// less.
TEST(EdgeIllumination, OneFaceOfALongEdge) {
  for (const Panel& face : {above, oblique}) {
    const Setting setting(60.0, {face});
    for (const Look& look : looks) {
      const LookVectors vectors = look_vectors(look);
      const double error = relative(setting.illuminated(vectors, 0), setting.by_points(vectors, false, Ends::shared));
      measured("one face against points", error, "of the sum of magnitudes");
      EXPECT_LE(error, 2e-4);
    }
  }
}

TEST(EdgeIllumination, OneReflectionAfterTheEdge) {
  const Setting setting(60.0, {above, right});
  for (const Look& look : looks) {
    const LookVectors vectors = look_vectors(look);
    const PointSum wanted = setting.by_points(vectors, true, Ends::shared);
    const double error = relative(setting.illuminated(vectors, 1), wanted),
                 without = relative(setting.illuminated(vectors, 0), wanted);
    measured("with one reflection", error, "of the sum of magnitudes");
    measured("with the reflection left out", without, "of the sum of magnitudes");
    EXPECT_LE(error, 1e-4);  // as with one face
    EXPECT_GE(without, 10 * error);
  }
}

// Glass with losses: 0.3 to 0.9 of a conductor's reflected light.
const Medium glass{{4.0, -0.5}, 1.0};

// As of conductors.
TEST(EdgeIllumination, FacesOfAMediumReflectByFresnelsCoefficients) {
  for (const Panel& face : {above, oblique}) {
    const Setting setting(60.0, {face}, glass), metal(60.0, {face});
    for (const Look& look : looks) {
      const LookVectors vectors = look_vectors(look);
      const PointSum wanted = setting.by_points(vectors, false, Ends::shared);
      const double error = relative(setting.illuminated(vectors, 0), wanted);
      measured("a face of glass against points", error, "of the sum of magnitudes");
      EXPECT_LE(error, 2e-4);
      EXPECT_GE(relative(metal.illuminated(vectors, 0), wanted), 5 * error);
    }
  }
}

TEST(EdgeIllumination, OneReflectionAfterTheEdgeByGlass) {
  const Setting setting(60.0, {above, right}, glass);
  for (const Look& look : looks) {
    const LookVectors vectors = look_vectors(look);
    const double error = relative(setting.illuminated(vectors, 1), setting.by_points(vectors, true, Ends::shared));
    measured("with one reflection by glass", error, "of the sum of magnitudes");
    EXPECT_LE(error, 1e-4);
  }
}

TEST(EdgeIllumination, AMediumThatConductsIsAConductor) {
  const Setting setting(60.0, {above, right}, Medium{{-1e24, -1e24}, 1.0}), metal(60.0, {above, right});
  for (const Look& look : looks) {
    const LookVectors vectors = look_vectors(look);
    const ScatteringMatrix wanted = metal.illuminated(vectors, 1);
    EXPECT_LE(frobenius_norm(setting.illuminated(vectors, 1) - wanted), 1e-9 * frobenius_norm(wanted));
  }
}

TEST(EdgeIllumination, WavesGoOnBeyondTheEndsOfTheEdge) {
  const Setting setting(0.8, {above});
  for (const Look& look : looks) {
    const LookVectors vectors = look_vectors(look);
    const PointSum wanted = setting.by_points(vectors, false, Ends::shared);
    const double error = relative(setting.illuminated(vectors, 0), wanted),
                 hard = relative(setting.by_points(vectors, false, Ends::cut).value, wanted);
    measured("beyond the ends", error, "of the sum of magnitudes");
    measured("beyond the ends, cut hard", hard, "of the sum of magnitudes");
    EXPECT_LE(error, 0.15 * hard);  // waves are faded out far from their end, where the formula has a tenth of them left
  }
}

}  // namespace
}  // namespace raytube
