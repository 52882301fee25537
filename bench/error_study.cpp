// Error of S against rays and time, for four ways to sample the same currents.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "bodies.h"
#include "closed_forms.h"
#include "monte_carlo.h"
#include "shapes.h"
#include "smooth_forms.h"
#include "studies.h"
#include "timing.h"
#include "vehicle.h"

namespace raytube::bench {

namespace {

constexpr double within_db = 20.0;  // of the peak over the looks: in a null a difference in dB says nothing

// Squared errors added up over repeats, looks and both co-polar channels.
struct ErrorSum {
  double squared_db = 0.0, squared = 0.0, reference = 0.0, rows = 0.0;

  double rms_db() const { return std::sqrt(squared_db / rows); }
  double relative() const { return std::sqrt(squared / reference); }

  void add(const std::vector<ScatteringMatrix>& scattering, const std::vector<ScatteringMatrix>& truth) {
    for (const int channel : {0, 1}) {
      double peak = 0.0;
      for (const ScatteringMatrix& s : truth) peak = std::max(peak, std::abs(s.at(channel, channel)));
      for (std::size_t i = 0; i < truth.size(); ++i) add(scattering[i].at(channel, channel), truth[i].at(channel, channel), peak);
    }
  }
  void add(Complex s, Complex exact, double peak) {
    squared += std::norm(s - exact);
    reference += std::norm(exact);
    if (std::abs(exact) < peak * std::pow(10.0, -within_db / 20.0)) return;
    squared_db += std::pow(20.0 * std::log10(std::abs(s) / std::abs(exact)), 2);
    ++rows;
  }
};

double relative_error(const std::vector<ScatteringMatrix>& scattering, const std::vector<ScatteringMatrix>& truth) {
  ErrorSum error;
  error.add(scattering, truth);
  return error.relative();
}

struct Truth {
  std::string from;
  std::vector<ScatteringMatrix> scattering;
  Json check = {};  // how far another method is from it
};

// Clipped tubes integrate over exactly what is lit, whatever the density; where a body has more facets than cells they need a
// fine one. The uniform grid comes from elsewhere to the same value.
Truth exact_tubes(const Body& body, double grid_density, int threads) {
  constexpr double density = 80.0, no_tolerance_db = 1e-9;
  Truth truth{fmt::format("adaptive at {} per wavelength", density),
              solved(body, body.sweep, adaptive(no_tolerance_db, threads, false, density)).scattering};
  const Outcome grid = solved(body, body.sweep, uniform(grid_density, threads));
  truth.check = {{"uniform_per_wavelength", grid_density}, {"relative_error", relative_error(grid.scattering, truth.scattering)}};
  return truth;
}

// S of both co-polar channels as a function of the look.
template <class Function>
std::vector<ScatteringMatrix> at_every_look(const Body& body, Function s) {
  std::vector<ScatteringMatrix> scattering;
  for (const Look& look : body.sweep.looks) scattering.push_back({{{{s(look.transmit, -1), 0.0}, {0.0, s(look.transmit, 1)}}}});
  return scattering;
}

Truth turned_plate(const Body& body, double side, double turn) {
  const double k = wavenumber(body.sweep.frequencies[0]);
  return {"closed form of a plate (Knott, Shaeffer & Tuley 2004, ch. 5)",
          at_every_look(body, [&](const Direction& look, int) { return closed_forms::plate(side, k, look, turn); })};
}

Truth upright_dihedral(const Body& body, double side) {
  const double k = wavenumber(body.sweep.frequencies[0]);
  return {"closed form of a dihedral (single bounces as plates, double bounce as flat aperture)",
          at_every_look(body,
                        [&](const Direction& look, int sign) { return closed_forms::dihedral(side, side, k, look.phi, sign); })};
}

Truth smooth_sphere(const Body& body, double radius) {
  const double k = wavenumber(body.sweep.frequencies[0]);
  return {"closed form of a sphere", at_every_look(body, [&](const Direction&, int) { return sphere_po(radius, k); })};
}

Truth smooth_cylinder(const Body& body, double radius, double length) {
  const double k = wavenumber(body.sweep.frequencies[0]);
  return {"closed form of a cylinder",
          at_every_look(body, [&](const Direction& look, int) { return cylinder_po(radius, length, k, look.theta); })};
}

Json point(const std::vector<Outcome>& outcomes, const Truth& truth) {
  ErrorSum error;
  for (const Outcome& outcome : outcomes) error.add(outcome.scattering, truth.scattering);
  const auto looks = static_cast<double>(truth.scattering.size());
  return {{"rays_per_look", static_cast<double>(outcomes[0].rays) / looks},
          {"seconds_per_look", median_seconds(outcomes) / looks},
          {"rms_db", error.rms_db()},
          {"relative_error", error.relative()}};
}

// What a body is measured against: facets against facets, curved surfaces against what the facets stand for.
struct Truths {
  Truth facets;
  std::optional<Truth> smooth = {};
};

struct Method {
  std::string name;
  std::vector<double> samples;  // cells per wavelength, tolerance [dB], or rays launched
  std::function<Run(double)> run;
  bool curved = false;
};

Method uniform_method(const Body& body, const std::vector<double>& densities, int threads) {
  return {"uniform", densities, [&body, threads](double density) -> Run {
            return [&body, options = uniform(density, threads)](int) { return solved(body, body.sweep, options); };
          }};
}

Method adaptive_method(const std::string& name, const Body& body, bool curved, const Settings& settings) {
  std::vector<double> tolerances{1, 0.1};
  if (!settings.quick) tolerances = {3, 1, 0.3, 0.1, 0.03, 0.01};
  return {name, tolerances,
          [&body, curved, threads = settings.threads](double tolerance) -> Run {
            return [&body, options = adaptive(tolerance, threads, curved)](int) { return solved(body, body.sweep, options); };
          },
          curved};
}

Outcome by_chance(const Body& body, std::uint64_t launched, std::uint64_t seed, int threads) {
  std::vector<RaySums> looks(body.sweep.looks.size());
  const auto start = Clock::now();
  on_threads(threads, [&] {
    tbb::parallel_for(std::size_t{0}, looks.size(), [&](std::size_t i) {
      looks[i] =
          ray_sums(body.target.tracer, body.sweep.looks[i], body.sweep.frequencies, TubeOptions().max_bounces, launched, seed, i);
    });
  });
  Outcome outcome{{}, 0, seconds_since(start)};
  for (const RaySums& look : looks) {
    outcome.scattering.push_back(look.scattering.front());
    outcome.rays += look.rays;
  }
  return outcome;
}

Method random_method(const Body& body, const Settings& settings) {
  std::vector<double> launches{1 << 10, 1 << 12, 1 << 14};
  if (!settings.quick) launches.insert(launches.end(), {1 << 16, 1 << 18});
  return {"Monte Carlo", launches, [&body, threads = settings.threads](double launched) -> Run {
            return [&body, threads, rays = static_cast<std::uint64_t>(launched)](int repeat) {
              return by_chance(body, rays, static_cast<std::uint64_t>(repeat) + 1, threads);
            };
          }};
}

std::vector<Method> methods(const Body& body, bool curved, const std::vector<double>& densities, const Settings& settings) {
  std::vector<Method> all{uniform_method(body, densities, settings.threads), adaptive_method("adaptive", body, false, settings)};
  if (curved) all.push_back(adaptive_method("adaptive, curved", body, true, settings));
  all.push_back(random_method(body, settings));
  return all;
}

std::vector<std::vector<Outcome>> outcomes_of(const std::vector<Method>& methods, int repeats) {
  std::vector<Run> runs;
  for (const Method& method : methods)
    for (const double sample : method.samples) runs.push_back(method.run(sample));
  return in_turn(runs, repeats);
}

Json study(const Body& body, const Truths& truths, const std::vector<double>& densities, const Settings& settings) {
  const std::vector<Method> all = methods(body, truths.smooth.has_value(), densities, settings);
  const std::vector<std::vector<Outcome>> outcomes = outcomes_of(all, settings.repeats);
  Json json = {{"body", body.name},
               {"triangles", body.target.mesh.triangles.size()},
               {"truth", truths.facets.from},
               {"check", truths.facets.check}};
  if (truths.smooth) json["smooth_truth"] = truths.smooth->from;
  std::size_t next = 0;
  for (const Method& method : all)
    for (const double sample : method.samples) {
      Json p = point(outcomes[next++], method.curved ? *truths.smooth : truths.facets);
      p["samples"] = sample;
      json["methods"][method.name].push_back(p);
    }
  return json;
}

// Looks beside every axis and plane of symmetry, at and around the strong returns.
Sweep plate_looks() { return looks_from({3e9}, {{0.5, 20}, {0.9, 65}, {1.3, 20}, {1.5, 65}, {2.7, 20}, {3.0, 50}}); }
Sweep trihedral_looks() { return looks_from({3e9}, {{45, 31}, {51, 53}, {55, 41}, {57, 47}, {62, 38}, {66, 57}}); }
Sweep sphere_looks() { return looks_from({3e9}, {{17, 4}, {41, 67}, {63, 131}, {88, 201}, {112, 262}, {149, 323}}); }
Sweep cylinder_looks() { return looks_from({10e9}, {{3, 7}, {88.2, 31}, {89.1, 101}, {90.3, 171}, {91.4, 241}, {176, 311}}); }

// Densities and sizes of one report.
struct Scope {
  std::vector<double> densities, coarse;
  double triangles;
  int vehicle_looks;
  double check_density;  // of the uniform grid that checks a truth
};

Json planar_bodies(const Scope& scope, const Settings& settings) {
  constexpr double plate_side = 1.5, turn = 33.0 * degree, dihedral_side = 0.15;
  const Body plate("plate turned 33°", build_mesh(shapes::plate(plate_side, turn), 1.0), plate_looks()),
      dihedral("dihedral", repository_mesh("cases/dihedral/case.toml"), dihedral_looks({94e9})),
      trihedral("trihedral", repository_mesh("cases/trihedral/case.toml"), trihedral_looks());
  return {study(plate, {turned_plate(plate, plate_side, turn)}, scope.densities, settings),
          study(dihedral, {upright_dihedral(dihedral, dihedral_side)}, scope.coarse, settings),
          study(trihedral, {exact_tubes(trihedral, scope.check_density, settings.threads)}, scope.densities, settings)};
}

Json curved_bodies(const Scope& scope, const Settings& settings) {
  const Body sphere("sphere", repository_mesh("cases/sphere/case.toml"), sphere_looks()),
      cylinder("cylinder", repository_mesh("cases/cylinder/case.toml"), cylinder_looks()),
      loader("vehicle", build_mesh(vehicle(scope.triangles), 1.0), looks_round(3e9, scope.vehicle_looks));
  const auto facets = [&](const Body& body) { return exact_tubes(body, scope.check_density, settings.threads); };
  return {study(sphere, {facets(sphere), smooth_sphere(sphere, 1.0)}, scope.densities, settings),
          study(cylinder, {facets(cylinder), smooth_cylinder(cylinder, 0.09, 0.3)}, scope.densities, settings),
          study(loader, {facets(loader)}, scope.densities, settings)};
}

}  // namespace

Json error_study(const Settings& settings) {
  const Scope quick{{2.5, 5, 10}, {0.5, 1, 2.5}, 1e4, 2, 20},
      full{{1, 2.5, 5, 10, 20, 40}, {0.25, 0.5, 1, 2.5, 5, 10}, 1e5, 6, 80};
  const Scope& scope = settings.quick ? quick : full;
  Json json = planar_bodies(scope, settings);
  for (Json& body : curved_bodies(scope, settings)) json.push_back(std::move(body));
  return json;
}

}  // namespace raytube::bench
