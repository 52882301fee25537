// Wedges with impedance faces: Maliuzhinets' function and edge wave, the limit of conductors, coats.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "run.h"
#include "unit/coated_cylinders.h"
#include "utd/impedance/impedance_strip.h"
#include "utd/impedance/impedance_table.h"

namespace raytube::testing {
namespace {

const std::array<double, 4> exterior_angles{1.2, 1.5, 1.75, 2.0};

double largest_difference(const ScatteringMatrix& a, const ScatteringMatrix& b) {
  double largest = 0.0;
  for (const int p : {0, 1})
    for (const int q : {0, 1}) largest = std::max(largest, std::abs(a.at(p, q) - b.at(p, q)));
  return largest;
}

/// psi(z + pi/2) psi(z - pi/2) = psi(pi/2)^2 cos(pi z / 4 Phi) and psi(z + 2 Phi) / psi(z - 2 Phi) = cot((z + pi/2)/2); the code
/// uses the first one beyond |Re w| = pi/2 only. Tolerance: rounding of a hundred terms.
TEST(Impedance, MaliuzhinetsFunctionHasItsIdentities) {
  std::mt19937_64 random(1958);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (const double n : exterior_angles) {
    const MaliuzhinetsFunction psi(n);
    const MaliuzhinetsPair square(psi, 0.0), apart(psi, pi / 2);
    EXPECT_LT(std::abs(apart(psi.point(0.0)) - 1.0), 1e-14);
    for (int i = 0; i < 200; ++i) {
      const Complex z(2.0 * part(random), 6.0 * part(random)), inner(1.5 * part(random), 6.0 * part(random)),
          a(1.5 * part(random), 3.0 * part(random)), cotangent = 1.0 / std::tan(0.5 * (z + pi / 2));
      EXPECT_LT(std::abs(square(psi.point(z + n * pi)) / square(psi.point(z - n * pi)) / (cotangent * cotangent) - 1.0), 1e-11)
          << n << " " << z;
      EXPECT_LT(std::abs(apart(psi.point(inner)) / std::cos(inner / (2 * n)) - 1.0), 1e-12) << n << inner;
      EXPECT_EQ(square(psi.point(z)), square(psi.point(-z)));
      const Complex product = MaliuzhinetsPair(psi, a)(psi.point(inner)),
                    squares = square(psi.point(inner + a)) * square(psi.point(inner - a));
      EXPECT_LT(std::abs(product * product / squares - 1.0), 1e-11) << n << inner << a;
    }
  }
}

FaceIncidence met_at(double source) { return {.tangent = z_axis, .sin_cone = 1.0, .source_angle = source, .lit = source < pi}; }

/// Edge wave of both faces at normal incidence.
Complex edge_wave(EdgeField field, double n, const MaliuzhinetsFunction& psi, std::array<Complex, 2> impedances, double source,
                  double observer) {
  const ImpedanceFace first(field, n, psi, face_angle(field, impedances[0], 1.0)),
      second(field, n, psi, face_angle(field, impedances[1], 1.0));
  const Complex at_source = faces_at(source_point(n, psi, met_at(source)), first, second);
  const WedgePoint here = wedge_point(n, psi, pi - observer), there = wedge_point(n, psi, pi - (n * pi - observer));
  return (faces_at(here, first, second) * whole_wave(n, here.g, source) +
          faces_at(there, second, first) * whole_wave(n, there.g, n * pi - source)) /
         at_source;
}

EdgeField field_of(const std::string& name) { return name == "soft" ? EdgeField::soft : EdgeField::hard; }

/// Table by quadrature of Maliuzhinets' integral (tests/data/impedance_wedges.py), printed with 12 digits.
TEST(Impedance, EdgeWavesAreThoseOfMaliuzhinets) {
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/impedance_wedges.csv");
  ASSERT_EQ(table.rows(), 120);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double n = table.number(i, "n");
    const Complex wanted = table.complex(i, "wave"),
                  found = edge_wave(field_of(table.text(i, "field")), n, MaliuzhinetsFunction(n),
                                    {table.complex(i, "z0"), table.complex(i, "zn")}, table.number(i, "source_deg") * degree,
                                    table.number(i, "observer_deg") * degree);
    EXPECT_LT(std::abs(found - wanted), 1e-10 * std::max(1.0, std::abs(wanted))) << "row " << i;
  }
}

TEST(Impedance, EdgeWavesAreReciprocal) {
  std::mt19937_64 random(1995);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const double n : exterior_angles) {
    const MaliuzhinetsFunction psi(n);
    for (int i = 0; i < 100; ++i) {
      const double a = part(random) * n * pi, b = part(random) * n * pi;
      const std::array<Complex, 2> impedances{Complex(2 * part(random), 4 * part(random) - 2),
                                              Complex(0.1 * part(random), 0.2 * part(random) - 0.1)};
      for (const EdgeField field : {EdgeField::soft, EdgeField::hard}) {
        const Complex there = edge_wave(field, n, psi, impedances, a, b), back = edge_wave(field, n, psi, impedances, b, a);
        EXPECT_LT(std::abs(there - back), 1e-9 * std::abs(there)) << n << " " << a << " " << b;
      }
    }
  }
}

std::vector<Look> random_looks(int count) {
  std::mt19937_64 random(1986);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto direction = [&] { return Direction{std::acos(2 * part(random) - 1), 2 * pi * part(random)}; };
  std::vector<Look> looks;
  for (int i = 0; i < count; ++i) {
    const Direction transmit = direction();
    looks.push_back({transmit, i % 2 ? transmit : direction()});
  }
  return looks;
}

/// Any look, on the cone of diffraction or off it. 1e-11 was found.
TEST(Impedance, WithoutImpedanceItIsTheFringeCurrentOfAConductor) {
  for (const double n : exterior_angles) {
    const MaliuzhinetsFunction psi(n);
    const Wedge wedge = wedge_along_z(n);
    for (const Look& look : random_looks(500)) {
      const LookVectors vectors = look_vectors(look);
      const WedgeIncidence incidence = incidence_on(wedge, vectors.incident);
      if (incidence.weight == 0.0) continue;
      bool windowed = false;
      const ScatteringMatrix wanted = amplitude_at(edge_amplitude(wedge, incidence, vectors), k, windowed),
                             found = ImpedanceEdge(wedge, incidence, psi, vectors).amplitude({}, k, windowed);
      EXPECT_LT(largest_difference(found, wanted), 1e-9 * std::max(1.0, frobenius_norm(wanted)))
          << n << " " << look.transmit.theta << " " << look.transmit.phi << " " << look.receive.theta << " " << look.receive.phi;
    }
  }
}

/// Fringe of a coated wedge, both antennas at these angles.
ScatteringMatrix coated(double n, double source, double observer) {
  const Wedge wedge = wedge_along_z(n);
  const LookVectors look = look_vectors({{pi / 2, source}, {pi / 2, observer}});
  bool windowed = false;
  return ImpedanceEdge(wedge, incidence_on(wedge, look.incident), MaliuzhinetsFunction(n), look)
      .amplitude({SurfaceImpedance{{0.4, 0.2}, {0.3, 0.3}}, {}}, k, windowed);
}

/// On the boundaries of reflection and of shadow, and beside them, where a quotient of differences becomes a slope. It changes by
/// its slope times the step of 2e-4; a pole there would add 1e4.
TEST(Impedance, FringesAreRegularAtTheBoundaries) {
  for (const double n : {1.5, 2.0})
    for (const double source : {50.0 * degree, 80.0 * degree})
      for (const double boundary : {pi - source, pi + source})
        for (const double step : {0.0, 1e-9, 9e-5, 1.1e-4}) {
          const ScatteringMatrix beside = coated(n, source, boundary - 2e-4);
          EXPECT_LT(largest_difference(coated(n, source, boundary + step), beside), 2e-3 * frobenius_norm(beside));
        }
}

/// Thin layers: Z = j k d (mu - 1) for E across and j k d (mu - 1/eps) for E in the plane of incidence, to the order of (kd)^2.
TEST(Impedance, OfAThinCoatIsThatOfItsConductorsPlane) {
  const Complex eps(4.0, -0.5), mu(1.5, -0.2);
  const double kd = 1e-4;
  const SurfaceImpedance found = surface_impedance(coat(eps, mu, kd / k), 0, k);
  EXPECT_LT(std::abs(found.soft / (Complex(0.0, kd) * (mu - 1.0)) - 1.0), 1e-6);
  EXPECT_LT(std::abs(found.hard / (Complex(0.0, kd) * (mu - 1.0 / eps)) - 1.0), 1e-6);
  EXPECT_EQ(found.depth, kd / k);
}

/// Its edges lie half-way between the metal and the coat's face, as that of a thin plate does.
Cylinder strip(double width, double thickness, const Material& material) {
  const dvec3 left(-width / 2, 0, 0), right(width / 2, 0, 0), up(0, thickness, 0);
  const SurfaceImpedance coated = surface_impedance(material, 0, k), metal;
  return {{{left + up, right + up, y_axis, &material}, {left, right, -y_axis, nullptr}},
          {{left + 0.5 * up, wedge_along_z(2.0), std::array{coated, metal}},
           {right + 0.5 * up, wedge_along_z(2.0, pi), std::array{metal, coated}}},
          {{{0, 1}, {0, 1}}, {{1, 0}, {1, 0}}, {{0, 1}, {1, 0}}, {{1, 0}, {0, 1}}}};
}

Cylinder square(double width, const Material& material) {
  const SurfaceImpedance coated = surface_impedance(material, 0, k);
  Cylinder result;
  for (int i = 0; i < 4; ++i) {
    const double turn = i * pi / 2;
    const dvec3 out(std::cos(turn), std::sin(turn), 0), next(-out.y, out.x, 0);
    result.sides.push_back({width / 2 * (out - next), width / 2 * (out + next), out, &material});
    result.edges.push_back({width / 2 * (out + next), wedge_along_z(1.5, turn - pi / 2), std::array{coated, coated}});
    const std::size_t here = static_cast<std::size_t>(i), before = static_cast<std::size_t>((i + 3) % 4);
    result.ways.push_back({{here, before}, {0, 1}});
    result.ways.push_back({{before, here}, {1, 0}});
  }
  return result;
}

/// rms error over the peak, physical optics alone, with edges, and with what H along them sends to the other edge, by body,
/// polarisation and side of the coat. What is left of the square is its corners.
TEST(Impedance, CoatedCylindersAreThoseOfTheIntegralEquation) {
  const std::map<std::string, std::array<double, 3>> most{
      // physical optics at least, with edges at most, with the ways between them at most
      {"strip 0.02 tm coat", {0.06, 0.0036, 0.0036}},  {"strip 0.02 tm metal", {0.035, 0.001, 0.001}},
      {"strip 0.02 te coat", {0.039, 0.020, 0.007}},   {"strip 0.02 te metal", {0.042, 0.022, 0.011}},
      {"strip 0.05 tm coat", {0.039, 0.0017, 0.0017}}, {"strip 0.05 tm metal", {0.04, 0.0013, 0.0013}},
      {"strip 0.05 te coat", {0.042, 0.032, 0.0092}},  {"strip 0.05 te metal", {0.055, 0.050, 0.025}},
      {"square 0.02 tm coat", {0.053, 0.029, 0.029}},  {"square 0.02 te coat", {0.04, 0.019, 0.0120}}};
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/coated_cylinders.csv");
  std::map<std::string, std::array<Error, 3>> errors;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double width = table.number(i, "width"), thickness = table.number(i, "thickness"),
                 degrees = table.number(i, "angle_deg");
    const Material material = coat(table.complex(i, "eps"), table.complex(i, "mu"), thickness);
    const bool is_strip = table.text(i, "body") == "strip", tm = table.text(i, "polarisation") == "tm";
    const Cylinder cylinder = is_strip ? strip(width, thickness, material) : square(width, material);
    const std::string name = table.text(i, "body") + " " + table.text(i, "thickness") + " " + table.text(i, "polarisation") +
                             (degrees < 180.0 ? " coat" : " metal");
    for (const int order : {0, 1, 2}) {
      const LookVectors look = seen_across(degrees * degree, degrees * degree);
      errors[name][order].add(amplitude(cylinder, look, tm, order), table.complex(i, "p"));
    }
  }
  ASSERT_EQ(errors.size(), most.size());
  for (const auto& [name, error] : errors) {
    EXPECT_GT(error[0].relative(), most.at(name)[0]) << name;
    EXPECT_LT(error[1].relative(), most.at(name)[1]) << name;
    EXPECT_LT(error[2].relative(), most.at(name)[2]) << name;
  }
}

/// There over the coat and back over it, antennas changed: also where the coat guides a wave (eps 4).
TEST(Impedance, WaysBetweenEdgesAreReciprocal) {
  for (const Material& material : {coat({4.0, -0.1}, 1.0, 0.05), coat({16.9, -0.39}, {2.46, -1.95}, 0.02)}) {
    const Cylinder cylinder = strip(3.0, material.layers[0][0].thickness, material);
    for (const double source : {0.6, 1.2, 2.5, 4.0})
      for (const double observer : {0.4, 1.7, 2.2, 5.0}) {
        const LookVectors there = look_vectors({{pi / 2, source}, {pi / 2, observer}}),
                          back = look_vectors({{pi / 2, observer}, {pi / 2, source}});
        const Complex first = of_way(cylinder.edges[0], cylinder.edges[1], {0, 1}, there),
                      second = of_way(cylinder.edges[1], cylinder.edges[0], {1, 0}, back);
        EXPECT_GT(std::abs(first), 1e-4);
        EXPECT_LT(std::abs(first - second), 1e-6 * std::abs(first)) << source << " " << observer;
      }
  }
}

/// Edges of a plate that strips leave and meet at different angles: the first along z, the far one turned in the plane by `turn`.
struct SkewWay {
  Wedge from = wedge_along_z(2.0), to = wedge_along_z(2.0);
  WedgeIncidence incidence;
  std::array<FaceIncidence, 2> arriving;
  LookVectors look;
  MaliuzhinetsFunction psi{2.0, strip_digits};

  SkewWay(double turn, const Look& of) : look(look_vectors(of)) {
    incidence = incidence_on(from, look.incident);
    const FaceIncidence& left = incidence.faces[0];
    const dvec3 strips = left.sin_cone * from.faces[0].into_face + left.cos_cone * left.tangent,
                into(-std::cos(turn), 0.0, std::sin(turn));
    to.faces = {WedgeFace{0, into, -y_axis, 1e30}, WedgeFace{0, into, y_axis, 1e30}};
    for (const int face : {0, 1}) {
      const dvec3 tangent = glm::cross(into, to.faces[face].normal);
      arriving[face] = {.tangent = tangent, .cos_cone = glm::dot(strips, tangent), .sin_cone = -glm::dot(strips, into)};
    }
  }

  /// Of strips k l long, by a path for others.
  Complex sum(const SurfaceImpedance& of, double length, double path_for, int nodes) const {
    const ImpedanceStrip way({from, 0, incidence.faces, psi}, {to, 1, arriving, psi}, look, path_for, nodes);
    StripBundle strips{};
    strips.to = 1.0, strips.length = length / k;
    const std::array<Complex, 2> both = way.echo({of, {}}, {SurfaceImpedance{}, of}).over(strips, k);
    return std::abs(both[0]) > std::abs(both[1]) ? both[0] : both[1];
  }
};

const std::vector<SurfaceImpedance> strip_impedances{
    {{}, 0.0},        {{}, {0.0, 0.02}},  {{}, {0.0, 0.26}},  {{}, {0.002, 0.1}}, {{}, {0.05, 0.05}},
    {{}, {0.3, 0.3}}, {{}, {0.1, 0.003}}, {{}, {0.3, -0.02}}, {{}, {0.5, 0.0}},   {{}, {0.01, -0.3}}};

/// However many points the path has, and however long the strips are that it was made for. Looks on the cone of diffraction and
/// off it.
TEST(Impedance, WaysBetweenEdgesDoNotDependOnTheirPath) {
  double worst = 0.0;
  for (const double turn : {0.0, 0.01, 0.3, -0.6})
    for (const Look& look : {Look{{1.2, 1.0}, {1.2, 1.0}}, Look{{1.0, 0.4}, {1.9, 2.6}}, Look{{2.1, 1.4}, {0.7, 4.0}}}) {
      const SkewWay way(turn, look);
      for (const SurfaceImpedance& of : strip_impedances)
        for (const double length : {3.0, 20.0, 150.0}) {
          const Complex wanted = way.sum(of, length, length, 48);
          for (const auto& [path_for, nodes] : {std::pair{0.7, strip_nodes}, {1.0, strip_nodes}, {1.5, strip_nodes}}) {
            const double error = std::abs(way.sum(of, length, path_for * length, nodes) - wanted) / std::abs(wanted);
            worst = std::max(worst, error);
            EXPECT_LT(error, 1e-3) << turn << " " << look.transmit.theta << " " << of.hard << " " << length << " " << path_for
                                   << " " << std::abs(wanted);
          }
        }
    }
  measured("ways between edges, 18 points against 48", worst, "");
}

/// Where the pole of the guided wave passes the path, and where the wave becomes too slow to count: steps from one impedance to
/// the next are small everywhere.
TEST(Impedance, WaysBetweenEdgesKnowNoStepOfGuidedWaves) {
  const auto impedances = [](auto of, double from, double step) {
    std::vector<SurfaceImpedance> all;
    for (int i = 0; i < 100; ++i) all.push_back({{}, of(from + i * step)});
    return all;
  };
  const std::vector<std::vector<SurfaceImpedance>> scans{
      impedances([](double phase) { return std::polar(0.1, phase); }, 0.6, 0.005),
      impedances([](double phase) { return std::polar(0.4, phase); }, 0.6, 0.005),
      impedances([](double size) { return Complex(0.01, size); }, 0.6, 0.005)};
  for (const double turn : {0.0, 0.3})
    for (const auto& scan : scans) {
      const SkewWay way(turn, {{1.0, 0.4}, {1.9, 2.6}});
      std::vector<Complex> sums;
      double largest = 0.0, step = 0.0;
      for (const SurfaceImpedance& of : scan) {
        sums.push_back(way.sum(of, 6.0, 6.0, strip_nodes));
        largest = std::max(largest, std::abs(sums.back()));
        if (sums.size() > 1) step = std::max(step, std::abs(sums.back() - sums[sums.size() - 2]));
      }
      EXPECT_LT(step, 0.05 * largest) << turn << " "
                                      << scan[0].hard;  // of 0.03: a wave that begins to count at once is 0.2 and more
    }
}

TEST(Impedance, TablesAreOfTheFrequencyAsked) {
  Material material = coat({4.0, -0.1}, 1.0, 1e-3);
  material.layers = {material.layers[0], coat({9.0, -0.1}, 1.0, 1e-3).layers[0]};
  const std::vector<double> frequencies{9e9, 9e9};  // twice the same, of another medium
  const ImpedanceTable table(std::span(&material, 1), frequencies);
  Wedge wedge = wedge_along_z(1.5);
  wedge.faces[0].material = 0;
  for (const std::size_t f : {0u, 1u}) {
    EXPECT_EQ(table.at(wedge, f)[0].hard, surface_impedance(material, f, wavenumber(frequencies[f])).hard);
    EXPECT_EQ(table.at(wedge, f)[1].hard, Complex(0.0));
  }
}

}  // namespace
}  // namespace raytube::testing
