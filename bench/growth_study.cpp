// How the time of a solve grows with what it is asked.
#include "bodies.h"
#include "studies.h"
#include "vehicle.h"

namespace raytube::bench {

namespace {

// One place on a curve: `x` of what grows, in one mode.
struct Place {
  double x;
  std::string mode;
  Run run;
};

Run run_of(const Body& body, const Sweep& sweep, const SolveOptions& options) {
  return [&body, sweep, options](int) { return solved(body, sweep, options); };
}

void add_both_modes(std::vector<Place>& places, double x, const Body& body, const Sweep& sweep, int threads) {
  places.push_back({x, "uniform", run_of(body, sweep, uniform(10.0, threads))});
  places.push_back({x, "adaptive", run_of(body, sweep, adaptive(0.1, threads))});
}

Json measured(const std::string& body, const std::string& variable, const std::vector<Place>& places, int repeats) {
  std::vector<Run> runs;
  for (const Place& place : places) runs.push_back(place.run);
  const std::vector<std::vector<Outcome>> outcomes = in_turn(runs, repeats);
  Json json = {{"body", body}, {"variable", variable}, {"points", Json::array()}};
  for (std::size_t i = 0; i < places.size(); ++i)
    json["points"].push_back(
        {{"x", places[i].x}, {"mode", places[i].mode}, {"rays", outcomes[i][0].rays}, {"solve_s", median_seconds(outcomes[i])}});
  return json;
}

const char* const dihedral_case = "cases/dihedral/case.toml";
const char* const trihedral_case = "cases/trihedral/case.toml";

Json with_frequency(const Settings& settings) {
  const Body body("dihedral of 150 mm, 4 looks", repository_mesh(dihedral_case), dihedral_looks({10e9}));
  std::vector<Place> places;
  for (double ghz = 10; ghz <= (settings.quick ? 40 : 320); ghz *= 2)
    add_both_modes(places, ghz, body, dihedral_looks({ghz * 1e9}), settings.threads);
  return measured(body.name, "GHz", places, settings.repeats);
}

Json with_triangles(const Settings& settings) {
  std::vector<double> sizes{1e3, 1e4};
  if (!settings.quick) sizes.insert(sizes.end(), {1e5, 1e6});
  Json json;
  for (const double triangles : sizes) {
    const Body body("vehicle, 3 GHz, 4 looks", build_mesh(vehicle(triangles), 1.0), looks_round(3e9, 4));
    std::vector<Place> places;
    add_both_modes(places, static_cast<double>(body.target.mesh.triangles.size()), body, body.sweep, settings.threads);
    const Json size = measured(body.name, "triangles", places, settings.repeats);
    if (json.is_null())
      json = size;
    else
      json["points"].insert(json["points"].end(), size["points"].begin(), size["points"].end());
  }
  return json;
}

// Looks that cost alike, so that only their number shows.
Sweep about_the_axis(int count) {
  Sweep sweep{{3e9}, {}, false};
  for (int i = 0; i < count; ++i) {
    const Direction look{54.0 * degree, (35.0 + 20.0 * (i + 0.5) / count) * degree};
    sweep.looks.push_back({look, look});
  }
  return sweep;
}

Json with_looks(const Settings& settings) {
  const Body body("trihedral, 3 GHz", repository_mesh(trihedral_case), about_the_axis(1));
  std::vector<Place> places;
  for (const int looks : {1, 4, 16, 64, 256}) {
    if (settings.quick && looks > 16) break;
    add_both_modes(places, looks, body, about_the_axis(looks), settings.threads);
  }
  return measured(body.name, "looks", places, settings.repeats);
}

Json with_frequencies(const std::string& name, const std::string& case_file, const Settings& settings) {
  const Body body(name + ", 92 to 96 GHz, 4 looks", repository_mesh(case_file), dihedral_looks({92e9}));
  std::vector<Place> places;
  for (const int count : {1, 11, 101, 1001}) {
    if (settings.quick && count > 11) break;
    // One frequency alone is the highest, which sets the grid of the others.
    std::vector<double> frequencies(static_cast<std::size_t>(count), 96e9);
    for (int i = 0; i + 1 < count; ++i) frequencies[static_cast<std::size_t>(i)] = 92e9 + 4e9 * i / (count - 1);
    add_both_modes(places, count, body, dihedral_looks(frequencies), settings.threads);
  }
  return measured(body.name, "frequencies", places, settings.repeats);
}

Json with_threads(const Body& body, const Settings& settings) {
  std::vector<Place> places;
  for (int threads = 1; threads <= settings.threads; threads *= 2) add_both_modes(places, threads, body, body.sweep, threads);
  return measured(body.name, "threads", places, settings.repeats);
}

}  // namespace

Json growth_study(const Settings& settings) {
  Json json = {with_frequency(settings), with_triangles(settings), with_looks(settings),
               with_frequencies("dihedral", dihedral_case, settings),
               with_frequencies("cube of 90 mm", "cases/powercube/case.toml", settings)};
  const int looks = settings.quick ? 16 : 256;
  json.push_back(with_threads({"trihedral, 3 GHz", repository_mesh(trihedral_case), about_the_axis(looks)}, settings));
  const double triangles = settings.quick ? 1e4 : 1e5;
  json.push_back(
      with_threads({"vehicle, 3 GHz", build_mesh(vehicle(triangles), 1.0), looks_round(3e9, settings.quick ? 2 : 12)}, settings));
  return json;
}

}  // namespace raytube::bench
