// Looks exactly face-on, edge-on, along a wedge, at the poles and at 360 degrees, and a hair beside them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "solve/look_solver.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

constexpr double frequency = 10e9;
const double lambda = wavelength(frequency);

struct Body {
  const char* name;
  PolygonSoup soup;
  std::vector<Direction> looks;  // special ones
};

Direction degrees(double theta, double phi) { return {theta * degree, phi * degree}; }

[[maybe_unused]] std::vector<Body> bodies() {
  const std::vector<Direction> axes = {degrees(0, 0),   degrees(0, 37),  degrees(180, 0),  degrees(90, 0), degrees(90, 90),
                                       degrees(90, 45), degrees(45, 45), degrees(90, 180), degrees(45, 0), degrees(135, 90)};
  return {{"plate", shapes::plate(3 * lambda), axes},
          {"cube", shapes::cube(2 * lambda), axes},
          {"dihedral", shapes::dihedral(2 * lambda, 3 * lambda), axes},
          {"trihedral", shapes::trihedral(2 * lambda), axes}};
}

constexpr int interaction_waves = 4;  // in the place of an order: 3, with waves between surfaces

/// Orders of edge currents: 0 is physical optics alone.
SolveOptions setting(TubeMode mode, int order) {
  SolveOptions o = options(order == 0 ? EdgeMethod::none : EdgeMethod::fringe);
  o.tubes.mode = mode;
  o.tubes.skip = false;  // every look for itself
  o.edges.order = std::clamp(order, 1, 3);
  o.edges.interaction = order == interaction_waves;
  o.edges.interaction_budget = unlimited_interaction_budget;  // what it gives is tested, not what it may cost
  return o;
}

double or_infinite(double x) { return std::isfinite(x) ? x : std::numeric_limits<double>::infinity(); }

/// One body's looks beside special ones, solved.
class Neighbourhood {
 public:
  Neighbourhood(const PolygonSoup& soup, const SolveOptions& o)
      : options_(o), loaded_(build_mesh(soup, 1.0)), target_(loaded_.mesh) {}

  /// What a plate as large as the body sends back, the unit of all changes.
  double peak() const { return wavenumber(frequency) * extent() * extent() / (4 * pi); }

  /// The most by which S / peak may change per radian: phases 2 k r, r to D/2, both for the change of a phase and for the borders
  /// of light that it moves.
  double slope() const { return 4 * wavenumber(frequency) * extent(); }

  /// S of a transmitter `step` from `at` along a great circle of this azimuth, in the bases carried along from `at`. Without
  /// `receiver` it comes with the transmitter.
  void add(const Direction& at, double azimuth, double step, const Direction* receiver) {
    const SphericalBasis b = spherical_basis(at);
    const dvec3 to = std::cos(azimuth) * b.theta_hat + std::sin(azimuth) * b.phi_hat;
    const dvec3 r = std::cos(step) * b.radial + std::sin(step) * to;
    Direction moved{std::atan2(std::hypot(r.x, r.y), r.z), std::atan2(r.y, r.x)};
    if (step == 0.0) moved = at;
    sweep_.looks.push_back({moved, receiver ? *receiver : moved});
    sweep_.bistatic = receiver != nullptr;
    const SphericalBasis here = spherical_basis(moved);
    const std::array<dvec3, 2> before{carried(b.theta_hat, b.radial, here.radial), carried(b.phi_hat, b.radial, here.radial)};
    glm::dmat2 turn;  // [before][here]
    for (int i = 0; i < 2; ++i) turn[i] = {glm::dot(before[i], here.theta_hat), glm::dot(before[i], here.phi_hat)};
    turns_.push_back(turn);
  }
  void add(const Look& look, bool bistatic) {
    sweep_.looks.push_back(look);
    sweep_.bistatic = bistatic;
    turns_.emplace_back(1.0);
  }

  void solve() {
    sweep_.frequencies = {frequency};
    result_ = raytube::solve(target_, sweep_, options_);
  }

  /// S / peak of look i.
  ScatteringMatrix at(std::size_t i) const {
    const glm::dmat2& t = turns_[i];
    const ScatteringMatrix& s = result_.total[i];
    ScatteringMatrix turned;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b) {
            const double receive = sweep_.bistatic ? (a == p ? 1.0 : 0.0) : t[p][a];
            turned.at(p, q) += receive * t[q][b] * s.at(a, b) / peak();
          }
    return turned;
  }

  /// The estimated error of look i over the peak.
  double error(std::size_t i) const {
    double largest = 0.0;
    for (const auto& row : result_.error[i])
      for (const double e : row) largest = std::max(largest, e / peak());
    return largest;
  }

  std::size_t size() const { return sweep_.looks.size(); }

 private:
  double extent() const { return 2 * loaded_.mesh.radius; }

  SolveOptions options_;
  LoadedMesh loaded_;
  Target target_;
  Sweep sweep_;
  std::vector<glm::dmat2> turns_;
  SweepResult result_;
};

const double azimuths[] = {0.0, pi / 2, 0.7};

const std::vector<double>& steps() {
  static const std::vector<double> all = [] {
    std::vector<double> values = {1e-12, 1e-8, 3e-5, 1e-4, 1e-3};
    for (double power = -11.5; power <= -3; power += size_of_run(10.0, 0.5)) values.push_back(std::pow(10.0, power));
    std::ranges::sort(values);
    return values;
  }();
  return all;
}

/// Largest changes over the peak, less what the slope and the estimated errors allow.
struct Changes {
  double at_look = 0.0;  // from the look itself to those beside it
  double beside = 0.0;   // from a step of 3e-5 to larger ones, the same way

  void include(const Changes& other) {
    at_look = std::max(at_look, other.at_look);
    beside = std::max(beside, other.beside);
  }
};

// The widest tie zone is 1e-6 (strip_waves.h: along_edge; sin_cone_floor); a step may lead across an edge by a tenth of its
// length only.
constexpr double clear_of_ties = 3e-5;

void measure(const Body& body, const Direction& look, const SolveOptions& o, const Direction* receiver, Changes& changes) {
  Neighbourhood near(body.soup, o);
  for (const double azimuth : azimuths)
    for (const double side : {-1.0, 1.0}) {
      near.add(look, azimuth, 0.0, receiver);
      for (const double step : steps()) near.add(look, azimuth, side * step, receiver);
    }
  near.solve();
  const std::size_t stride = steps().size() + 1;
  const auto clear = static_cast<std::size_t>(std::ranges::find(steps(), clear_of_ties) - steps().begin()) + 1;
  const auto change = [&](std::size_t i, std::size_t j, double step) {
    return largest_amplitude(near.at(i) - near.at(j)) - near.slope() * step - near.error(i) - near.error(j);
  };
  for (std::size_t line = 0; line < near.size(); line += stride)
    for (std::size_t i = 1; i < stride; ++i) {
      const double step = steps()[i - 1];
      changes.at_look = std::max(changes.at_look, or_infinite(change(line, line + i, step)));
      if (i > clear) changes.beside = std::max(changes.beside, or_infinite(change(line + clear, line + i, step)));
    }
}

/// The largest of all bodies, orders and looks that `included` names.
template <class Included>
Changes largest(const std::vector<int>& orders, TubeMode mode, const Direction* receiver, Included included) {
  Changes all;
  for (const Body& body : bodies())
    for (const int order : orders)
      for (const Direction& look : body.looks)
        if (included(body, look)) measure(body, look, setting(mode, order), receiver, all);
  return all;
}

constexpr const char* around = "looks face-on, edge-on, along edges and at the poles against those 1e-12 ... 1e-3 beside";
constexpr const char* beside = "from 3e-5 beside these looks to 1e-3";
constexpr const char* targets = "plate, cube, dihedral, trihedral";

TEST(Looks, PhysicalOptics) {
  // Monostatic S changes with nothing but phases and the borders of light. A radar that looks along one face of the dihedral or
  // the trihedral grazes it: the strip of the other face that it shadows, or that it mirrors, comes and goes with the slope
  // below.
  const auto any = [](const Body&, const Direction&) { return true; };
  const Changes flat = largest({0}, TubeMode::adaptive, nullptr,
                               [](const Body& body, const Direction&) { return body.soup.polygons.size() != 4; });
  expect_stable({fmt::format("{}: change beyond slope times step, over the peak of a plate as large", around),
                 "plate, cube, trihedral; adaptive tubes, edges off, monostatic", flat.at_look, 1e-4,
                 "slope 4 k D per radian; light that grazes a face ends at 1e-7 rad"});
  const Changes sampled = largest({0}, TubeMode::uniform, nullptr, any);
  expect_stable({"the same, less the estimated errors of both looks", fmt::format("{}; uniform tubes, edges off", targets),
                 sampled.at_look, 1e-9, "the grid's cells may change in number"});
}

TEST(Looks, EdgesMonostatic) {
  // Currents that end with their faces are continuous but where a face is grazed from the side of its other edges: what a hard
  // wave does there depends on the way it is approached (incidence.h), as physical optics does of a face that a fold mirrors.
  const std::vector<int> orders = size_of_run(std::vector{3}, std::vector{2, 3});
  const auto of_plate = [](const Body& body, const Direction&) { return body.soup.polygons.size() == 2; };
  const auto of_others = [&](const Body& body, const Direction& look) {
    return !of_plate(body, look) && (size_of_run(false, true) || look.theta == 0.0 || body.soup.polygons.size() == 3);
  };
  const Changes plate = largest(orders, TubeMode::adaptive, nullptr, of_plate);
  const Changes others = largest(orders, TubeMode::adaptive, nullptr, of_others);
  const Changes waves = largest({interaction_waves}, TubeMode::adaptive, nullptr, of_others);
  const std::string bodies = "cube, dihedral, trihedral";
  expect_stable({fmt::format("{}: change beyond slope times step, over the peak", around), "plate; edges, monostatic",
                 plate.at_look, 1e-5, "continuous; quadrature of strips that end at a corner"});
  expect_stable({"the same", fmt::format("{}; edges, monostatic", bodies), others.at_look, 0.03,
                 "a hard wave over a grazed face depends on the way it is approached (docs/theory/edges.md)"});
  expect_stable(
      {"the same", fmt::format("{}; edge-face interaction, monostatic", bodies), waves.at_look, 0.06,
       "waves mirrored in a corner end in the plane of its face: 0.3 wavelengths of a trihedral (docs/theory/interaction.md)"});
  expect_stable({beside, fmt::format("{}; edges, edge-face interaction, monostatic", targets),
                 std::max({plate.beside, others.beside, waves.beside}), 1e-5, "continuous"});
}

TEST(Looks, EdgesBistatic) {
  // A lit face grazed has a current on one side only, and none once it is passed: a step of physical optics of k A / (2 pi), over
  // the peak 2 A / D^2, of the trihedral's faces a third. Borders of what is lit by edges cross a receiver's direction, too.
  const std::vector<int> orders = size_of_run(std::vector{0, 3}, std::vector{0, 1, 2, 3});
  const auto some = [](const Body& body, const Direction& look) {
    return size_of_run(false, true) || look.phi == 0.0 || body.soup.polygons.size() == 2;
  };
  Changes edges, waves;
  for (const Direction& receiver : {degrees(60, 20), degrees(90, 180), degrees(180, 0)}) {
    if (size_of_run(true, false) && receiver.theta == pi) continue;
    edges.include(largest(orders, TubeMode::adaptive, &receiver, some));
    if (size_of_run(false, true)) waves.include(largest({interaction_waves}, TubeMode::adaptive, &receiver, some));
  }
  expect_stable({fmt::format("{}: change beyond slope times step, over the peak", around),
                 fmt::format("{}; bistatic, forward scatter among them, edges off and on", targets),
                 std::max(edges.at_look, waves.at_look), 0.33, "steps of the currents where a face is grazed"});
  expect_stable({beside, fmt::format("{}; bistatic, edges off and on", targets), edges.beside, 1e-5, "continuous"});
  if (size_of_run(false, true))
    expect_stable({beside, fmt::format("{}; bistatic, edge-face interaction", targets), waves.beside, 0.023,
                   "0.14 wavelengths where the look crosses a plane of symmetry of a corner (docs/theory/interaction.md)"});
}

TEST(Looks, WholeTurnsAndMinusZero) {
  // A turn is a multiple of 2 pi only to its rounding, 4e-16 rad, times slope; -0 is 0.
  double turned = 0.0, zero = 0.0;
  for (const Body& body : bodies())
    for (const bool bistatic : {false, true}) {
      Neighbourhood near(body.soup, setting(TubeMode::adaptive, 3));
      const auto both = [&](const Direction& a) { near.add(Look{a, bistatic ? degrees(60, 20) : a}, bistatic); };
      for (const auto& [theta, phi] : {std::pair{0.7, 0.4}, {1.2, 2.6}, {2.5, 5.1}, {1.0, 0.0}})
        for (const double turns : {0.0, 1.0, -1.0, 2.0}) both({theta, phi + turns * 2 * pi});
      for (const auto& [theta, phi] : {std::pair{0.0, 0.0}, {0.0, -0.0}, {-0.0, 0.0}, {1.0, -0.0}}) both({theta, phi});
      near.solve();
      for (std::size_t i = 0; i < 16; ++i)
        turned = std::max(turned, or_infinite(largest_amplitude(near.at(i) - near.at(i / 4 * 4))));
      for (const auto& [i, j] : {std::pair{17, 16}, {18, 16}, {19, 12}})
        zero = std::max(zero, or_infinite(largest_amplitude(near.at(i) - near.at(j))));
    }
  expect_stable({"phi plus 360, -360, 720 degrees: change over the peak", fmt::format("{}; edges", targets), turned, 1e-12,
                 "4e-16 rad of a turn times slope, 1e3 at most"});
  expect_stable({"-0 in the place of 0: change over the peak", fmt::format("{}; edges", targets), zero, 0.0, "the same number"});
}

}  // namespace
}  // namespace raytube::testing
