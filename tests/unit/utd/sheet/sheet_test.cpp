// Edges of thin material plates: split functions, half planes, strips against full-wave tables.
#include <gtest/gtest.h>

#include <random>

#include "run.h"
#include "utd/sheet/sheet_edges.h"
#include "unit/utd_scene.h"

namespace raytube::testing {
namespace {

constexpr double k = 2 * pi;  // wavelength 1 m
constexpr double width = 3.0, length = 40.0;
constexpr double vacuum_impedance = 376.730313668;  // [ohm]
const dvec3 x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

Material slab(Complex permittivity, Complex permeability, double thickness) {
  return {"slab", MaterialKind::sheet, 0.0, {{{{permittivity, permeability}, thickness}}}};
}

Material film(double resistance) {
  Material material{"film", MaterialKind::thin_sheet, 0.0, {}};
  material.resistance = resistance * vacuum_impedance;
  return material;
}

/// Z(a) Z(-a) Q = s or 1: equal steps on the imaginary axis, regular there.
TEST(Sheets, SplitFunctionsMultiplyToTheWhole) {
  std::mt19937_64 random(1931);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (const SheetChannel channel : {SheetChannel::curl, SheetChannel::divergence})
    for (int i = 0; i < 100; ++i) {
      const Complex constant(3.0 * part(random), 4.0 * part(random) - 2.0);
      const SplitFunction split(channel, constant,
                                channel == SheetChannel::curl ? Complex(0.1 * part(random), part(random)) : 0.0);
      for (const Complex a : {Complex(0.01), Complex(0.3), Complex(0.999), Complex(0.0, 0.4), Complex(0.5, 0.2)}) {
        const Complex s = std::sqrt(1.0 - a * a), whole = channel == SheetChannel::curl ? s : 1.0;
        EXPECT_LT(std::abs(split.at(a) * split.at(-a) * split.kernel(s, a) / whole - 1.0), 1e-8) << a << " " << constant;
      }
    }
}

/// Measured by the theory's own boundary integrals: jC of 2.61, 4 and 16.9 is .238, .301, .477.
TEST(Sheets, EndFacesMoveTheEdge) {
  const auto moved = [](Complex ratio) { return (Complex(0.0, 1.0) * end_face_shift(ratio)).real(); };
  EXPECT_NEAR(moved(2.61), 0.238, 1e-3);
  EXPECT_NEAR(moved(4.0), 0.301, 1e-3);
  EXPECT_NEAR(moved(16.9), 0.477, 1e-3);
  EXPECT_EQ(std::abs(end_face_shift(1.0)), 0.0);
}

SheetPair pair_of(const Material& material) { return sheet_pair(material, 0, k); }

/// Reciprocity of a half plane: E of one wave times the current that another one drives.
double not_reciprocal(const SheetAdmittance& sheet, double cone) {
  const double sine = std::sin(cone), b = std::cos(cone), c = 0.4 * sine, nu = 0.75 * sine;
  const SheetHalfPlane half_plane(sheet, std::numeric_limits<double>::infinity(), sine, k);
  const SheetVector one{0.3, 0.8}, other{-0.7, 0.5};
  const auto reaction = [&](double from, double to, double along, const SheetVector& lit, const SheetVector& seen) {
    const auto sources = half_plane.plane_wave(from, along, lit);
    const SheetVector m = half_plane.moment(sources, half_plane.constants(sources, along), to, along);
    return m.across * seen.across + m.along * seen.along;
  };
  const Complex there = reaction(c, nu, b, one, other), back = reaction(nu, c, -b, other, one);
  return std::abs(there - back) / std::abs(there);
}

TEST(Sheets, HalfPlanesOfFilmsAreReciprocal) {
  for (const double degrees : {90.0, 80.0, 60.0, 25.0})
    EXPECT_LT(not_reciprocal(pair_of(film(0.3)).electric, degrees * degree), 1e-12);
}

/// Exact for currents that the layer's admittance alone makes; the finite thickness enters by a mean that is reciprocal at normal
/// incidence only. A thick absorber is worst.
TEST(Sheets, HalfPlanesOfLayersAreNearlyReciprocal) {
  EXPECT_LT(not_reciprocal(pair_of(slab({2.61, -0.035}, 1.0, 0.02)).electric, 60 * degree), 5e-3);
  EXPECT_LT(not_reciprocal(pair_of(slab({2.61, -0.035}, 1.0, 0.02)).magnetic, 60 * degree), 5e-3);
  EXPECT_LT(not_reciprocal(pair_of(slab({16.9, -0.39}, {2.46, -1.95}, 0.05)).electric, 60 * degree), 0.08);
}

/// A film that hardly conducts is lit by the incident wave alone (Born).
TEST(Sheets, FilmsThatHardlyConductAreLitAsIfTheyWereNotThere) {
  constexpr double resistance = 1e6;
  const SheetPair pair = pair_of(film(resistance));
  const double sine = std::sin(65 * degree), b = std::cos(65 * degree), c = 0.3 * sine, nu = -0.8 * sine;
  const SheetHalfPlane half_plane(pair.electric, pair.slowest, sine, k);
  const SheetVector incident{0.6, -0.8};
  const auto sources = half_plane.plane_wave(c, b, incident);
  const SheetVector found = half_plane.moment(sources, half_plane.constants(sources, b), nu, b),
                    born = imaginary_unit / (nu + c) / resistance * incident;
  EXPECT_LT(std::abs(found.across - born.across) + std::abs(found.along - born.along), 1e-5 * std::abs(born.along));
}

/// A plate in y = 0 whose long rims run along z.
struct Plate {
  test::Scene scene;
  Outlines outlines;
  std::vector<Material> materials;

  explicit Plate(const Material& material) : materials{material} {
    test::add_panel(scene.mesh, dvec3(0.0), 0.5 * length * z_axis, 0.5 * width * x_axis);
    scene.mesh.patches[0].material = 0;
    add_rim({-0.5 * width, 0, -0.5 * length}, {-0.5 * width, 0, 0.5 * length}, x_axis);
    add_rim({0.5 * width, 0, -0.5 * length}, {0.5 * width, 0, 0.5 * length}, -x_axis);
    outlines = Outlines(scene.mesh, scene.wedges, 1.0 * degree);
  }

  void add_rim(const dvec3& start, const dvec3& end, const dvec3& into_face) {
    Wedge wedge = test::half_plane(start, end, into_face, scene.mesh.patches[0].normal, width, 0);
    if (glm::dot(wedge.end - wedge.start, glm::cross(into_face, wedge.faces[0].normal)) < 0.0) std::swap(wedge.start, wedge.end);
    for (WedgeFace& face : wedge.faces) face.material = 0;
    wedge.faces[1].back = true;
    scene.wedges.push_back(wedge);
  }
};

/// What the rims add, up to some order.
ScatteringMatrix rims(const Plate& plate, const Look& look, int order) {
  const std::vector<double> frequencies{speed_of_light};
  const LookVectors vectors = look_vectors(look);
  const SheetTable table(plate.materials, frequencies);
  SheetEdges edges({plate.scene.wedges, plate.outlines, plate.materials, table}, vectors, frequencies, order);
  std::vector<ScatteringMatrix> first(1), higher(1);
  const LitInterval whole{0.0, 1.0};
  for (std::uint32_t i = 0; i < 2; ++i)
    edges.add(i, incidence_on(plate.scene.wedges[i], vectors.incident), std::span(&whole, 1), first, higher);
  return first[0] + higher[0];
}

/// P of the plate's physical optics for E along it: -(1/4) of the electric and (1/4) sin sin' of the magnetic moment.
Complex physical_optics(const Material& material, double source, double observer) {
  const SheetPair pair = pair_of(material);
  const double s = std::abs(std::sin(source)), c = std::cos(source), half = 0.5 * k * width * (std::cos(observer) + c);
  const Complex electric = pair.electric.exact(s)[0], magnetic = pair.magnetic.empty() ? 0.0 : pair.magnetic.exact(s)[1];
  const double across = k * width * (half == 0.0 ? 1.0 : std::sin(half) / half);
  return across * (-0.25 * 2.0 * s * electric / (2.0 * s + electric) +
                   0.25 * std::sin(source) * std::sin(observer) * 2.0 * magnetic / (2.0 + s * magnetic));
}

/// S of a length is (j/pi) P.
Complex strip(const Plate& plate, double source, double observer, int order) {
  const auto towards = [](double angle) { return Direction{pi / 2, angle}; };
  const Complex of_rims = rims(plate, {towards(source), towards(observer)}, order).vv() / length;
  return physical_optics(plate.materials[0], source, observer) - imaginary_unit * pi * of_rims;
}

struct Errors {
  std::array<double, 3> back{};   // per order
  std::array<double, 2> apart{};  // order 3, sources at 20 and 60 degrees
};

/// rms over the peak.
class StripErrors {
 public:
  void add(Complex wanted, Complex found) {
    peak_ = std::max(peak_, std::abs(wanted));
    differences_.push_back(std::abs(found - wanted));
  }
  double value() const { return rms(differences_) / peak_; }

 private:
  double peak_ = 0.0;
  std::vector<double> differences_;
};

struct SlabCase {
  Complex permittivity, permeability;
  double thickness;
  std::string field;
  Errors theory;
};

/// What the theory reaches in numpy with 40 waves on the cut: rms error over the peak, order 1, 2, 3.
const std::vector<SlabCase> slab_cases{{{2.61, -0.035}, 1.0, 0.02, "tm", {{.0102, .0028, .0000}, {.0000, .0000}}},
                                       {{2.61, -0.035}, 1.0, 0.02, "te", {{.0015, .0002, .0001}, {.0001, .0001}}},
                                       {{2.61, -0.035}, 1.0, 0.05, "tm", {{.0246, .0114, .0003}, {.0002, .0002}}},
                                       {{2.61, -0.035}, 1.0, 0.05, "te", {{.0037, .0012, .0006}, {.0004, .0005}}},
                                       {{2.61, -0.035}, 1.0, 0.1, "tm", {{.0413, .0310, .0021}, {.0021, .0020}}},
                                       {{2.61, -0.035}, 1.0, 0.1, "te", {{.0087, .0045, .0027}, {.0021, .0022}}},
                                       {{4.0, -0.1}, 1.0, 0.02, "tm", {{.0181, .0072, .0000}, {.0000, .0000}}},
                                       {{4.0, -0.1}, 1.0, 0.02, "te", {{.0012, .0003, .0003}, {.0002, .0003}}},
                                       {{4.0, -0.1}, 1.0, 0.05, "tm", {{.0369, .0266, .0006}, {.0012, .0007}}},
                                       {{4.0, -0.1}, 1.0, 0.05, "te", {{.0033, .0015, .0011}, {.0009, .0012}}},
                                       {{4.0, -0.1}, 1.0, 0.1, "tm", {{.0418, .0252, .0041}, {.0111, .0033}}},
                                       {{4.0, -0.1}, 1.0, 0.1, "te", {{.0098, .0062, .0045}, {.0034, .0040}}},
                                       {{16.9, -0.39}, {2.46, -1.95}, 0.02, "tm", {{.0141, .0052, .0006}, {.0008, .0004}}},
                                       {{16.9, -0.39}, {2.46, -1.95}, 0.02, "te", {{.0024, .0015, .0015}, {.0013, .0011}}},
                                       {{16.9, -0.39}, {2.46, -1.95}, 0.05, "tm", {{.0053, .0051, .0051}, {.0037, .0018}}},
                                       {{16.9, -0.39}, {2.46, -1.95}, 0.05, "te", {{.0152, .0098, .0097}, {.0064, .0038}}}};

/// H along the plate is E along that of the medium with permittivity and permeability exchanged.
Material along_e(const SlabCase& of) {
  return of.field == "tm" ? slab(of.permittivity, of.permeability, of.thickness)
                          : slab(of.permeability, of.permittivity, of.thickness);
}

// Against boundary integrals on the real rectangle (tests/data/slab_strips.py). The tolerance is a fifth of the theory's own
// error and what its printed digits hide; bistatic, 24 waves in the place of 40 beside a guided one near the cut.
TEST(Sheets, StripsOfSlabsAreThoseOfTheTheory) {
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/slab_strips.csv");
  for (const SlabCase& of : slab_cases) {
    const Plate plate(along_e(of));
    std::array<StripErrors, 3> back;
    std::array<StripErrors, 2> apart;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      if (table.text(i, "field") != of.field || table.number(i, "thickness") != of.thickness ||
          table.number(i, "eps_re") != of.permittivity.real())
        continue;
      const double source = table.number(i, "source_deg"), observer = table.number(i, "observer_deg");
      const auto at = [&](int order) { return strip(plate, source * degree, observer * degree, order); };
      const Complex wanted = table.complex(i, "p");
      if (source == observer)
        for (int order = 1; order <= 3; ++order) back[order - 1].add(wanted, at(order));
      else
        apart[source == 20.0 ? 0 : 1].add(wanted, at(3));
    }
    SCOPED_TRACE(of.field + " " + std::to_string(of.permittivity.real()) + " " + std::to_string(of.thickness));
    for (int i = 0; i < 3; ++i) EXPECT_LT(back[i].value(), 1.2 * of.theory.back[i] + 1.5e-4) << "order " << i + 1;
    for (int i = 0; i < 2; ++i) EXPECT_LT(apart[i].value(), 1.2 * of.theory.apart[i] + 1.5e-3) << "bistatic " << i;
  }
}

struct FilmCase {
  double resistance;
  std::string field;
  std::array<double, 3> theory;
};

TEST(Sheets, StripsOfFilmsAreThoseOfTheTheory) {
  const std::vector<FilmCase> cases{{0.01, "tm", {3.8e-4, 5.5e-5, 3.6e-7}}, {0.1, "tm", {5.8e-4, 9.3e-5, 3.0e-6}},
                                    {1.0, "tm", {2.5e-3, 5.9e-4, 1.2e-5}},  {10.0, "tm", {2.8e-3, 3.1e-4, 1.7e-5}},
                                    {0.01, "te", {3.1e-2, 7.4e-3, 2.3e-4}}, {0.1, "te", {1.3e-2, 1.3e-3, 3.4e-5}},
                                    {1.0, "te", {5.2e-4, 7.1e-6, 6.1e-6}},  {10.0, "te", {2.6e-5, 8.7e-7, 8.7e-7}}};
  const Table table(RAYTUBE_SOURCE_DIR "/tests/data/resistive_strips.csv");
  for (const FilmCase& of : cases) {
    Material material = film(of.resistance);
    if (of.field == "te") {
      material.resistance = std::numeric_limits<double>::infinity();
      material.conductance = of.resistance / vacuum_impedance;  // its dual
    }
    const Plate plate(material);
    std::array<StripErrors, 3> errors;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      if (table.text(i, "field") != of.field || table.number(i, "resistance") != of.resistance) continue;
      const double angle = table.number(i, "angle_deg") * degree;
      for (int order = 1; order <= 3; ++order) errors[order - 1].add(table.complex(i, "p"), strip(plate, angle, angle, order));
    }
    for (int i = 0; i < 3; ++i)
      EXPECT_LT(errors[i].value(), 1.2 * of.theory[i] + 2e-5) << of.field << " " << of.resistance << " order " << i + 1;
  }
}

TEST(Sheets, DualMediaExchangeThePolarisations) {
  const Look look{{1.1, 0.4}, {1.9, 0.9}};
  const Plate plate(slab({2.61, -0.035}, {1.3, -0.2}, 0.04)), dual(slab({1.3, -0.2}, {2.61, -0.035}, 0.04));
  const ScatteringMatrix s = rims(plate, look, 3), t = rims(dual, look, 3);
  EXPECT_LT(std::abs(s.vv() + t.hh()) + std::abs(s.hh() + t.vv()), 1e-10 * std::abs(s.vv()));
}

/// A film without resistance is a conductor: first order of utd/wedge, in any direction.
TEST(Sheets, FilmsWithoutResistanceAreConductors) {
  const Plate plate(film(1e-9));
  std::vector<Wedge> conductors = plate.scene.wedges;
  for (Wedge& wedge : conductors)
    for (WedgeFace& face : wedge.faces) face.material = no_index;
  const SheetTable table(plate.materials, std::vector{speed_of_light});
  for (const Look& look : {Look{{1.2, 0.7}, {1.2, 0.7}}, Look{{0.6, 0.3}, {2.2, 2.5}}, Look{{2.0, -1.0}, {1.3, 0.4}}}) {
    const LookVectors vectors = look_vectors(look);
    SheetHalfPlanes half_planes;
    for (std::uint32_t i = 0; i < 2; ++i) {
      const WedgeIncidence incidence = incidence_on(plate.scene.wedges[i], vectors.incident);
      const WedgeFace& face = plate.scene.wedges[i].faces[0];
      const RimLook rim(face, incidence.faces[0], vectors.scattered);
      const SheetHalfPlane& sheet = half_planes.at(table.at(0, speed_of_light), true, rim.sin_cone, k);
      bool windowed = false;
      const ScatteringMatrix wanted = amplitude_at(edge_amplitude(conductors[i], incidence, vectors), k, windowed);
      for (int transmit = 0; transmit < 2; ++transmit) {
        const Received s = received(sheet_fringe(sheet, rim.nu, -glm::dot(vectors.incident, face.into_face), rim.b,
                                                 driving_field(rim, vectors, true, transmit)),
                                    rim, vectors, true);
        for (int receive = 0; receive < 2; ++receive) EXPECT_LT(std::abs(s[receive] - wanted.at(receive, transmit)), 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace raytube::testing
