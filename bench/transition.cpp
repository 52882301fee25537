// Transition functions side by side in one run: error and time of F, of a strip's kernels, and of the edge pass on a plate.
//   transition_tiers [--repeat N]
// Times are medians of the repeats, the tiers taken in turn. Errors are differences to the exact tier, divided by what is larger
// than 1. One thread.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>

#include "case/data/names.h"
#include "solve/solve.h"
#include "utd/fringe/edges.h"
#include "utd/multiple/strip_kernels.h"

namespace {

using namespace raytube;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + values.size() / 2);
  return values[values.size() / 2];
}

template <class Work>
double seconds(Work work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Values of one tier and the time per value.
struct Series {
  std::vector<Complex> values;
  double time = 0.0;
};

// F at X = 1e-4 to 1e3, eight at a time.
Series transition_series(TransitionTier tier) {
  constexpr int blocks = 20000;
  const ScaledErfc scaled_erfc = scaled_erfc_of(tier);
  Series series;
  series.values.reserve(blocks * lanes);
  series.time = seconds([&] {
                  for (int block = 0; block < blocks; ++block) {
                    Reals x;
                    for (std::size_t i = 0; i < lanes; ++i)
                      x[i] = 0.01 + 31.6 * (static_cast<double>(i) + block / double(blocks)) / lanes;
                    const Complexes w = scaled_erfc(x);
                    for (std::size_t i = 0; i < lanes; ++i) series.values.push_back(std::sqrt(pi) * x[i] * w[i]);
                  }
                }) /
                (blocks * lanes);
  return series;
}

// G_h of strips of 0.2 to 60 radians for sources and observers all around a half plane and an edge of 90 degrees.
Series kernel_series(TransitionTier tier) {
  std::vector<double> lengths;
  for (int i = 0; i < 256; ++i) lengths.push_back(0.2 * std::pow(300.0, i / 255.0));
  Series series;
  KernelBatch batch;
  const auto add = [&](double n, double source, double half_cosine) {
    const FaceIncidence incidence{dvec3(0, 0, 1), 0.0, 1.0, source, source < pi};
    series.time += seconds([&] { Strip(n, incidence, half_cosine, tier).at(lengths, batch); });
    for (std::size_t i = 0; i < lengths.size(); ++i) series.values.push_back(batch.hard[i]);
  };
  for (const double n : {2.0, 1.5})
    for (double source = 0.05; source < n * pi; source += 0.1)
      for (double half_cosine = 0.05; half_cosine < 1.2; half_cosine += 0.1) add(n, source, half_cosine);
  series.time /= static_cast<double>(series.values.size());
  return series;
}

// Edge part of S of a plate of 3 x 3 wavelengths [wavelengths], order 3, monostatic, every degree of elevation in two cuts.
Series plate_series(const Target& plate, TransitionTier tier) {
  const double frequency[] = {speed_of_light};
  Series series;
  int looks = 0;
  for (const double phi : {0.0, 30.0})
    for (double theta = 0.5; theta < 90; theta += 1, ++looks) {
      const Direction direction{theta * degree, phi * degree};
      EdgeLookResult found;
      series.time += seconds([&] {
        found =
            fringe_scattering({plate.wedges, plate.outlines, plate.tracer}, {direction, direction}, frequency, {3, false, tier});
      });
      const ScatteringMatrix s = found.scattering[0] + found.higher[0];
      series.values.insert(series.values.end(), {s.vv(), s.hh()});
    }
  series.time /= looks;
  return series;
}

struct Errors {
  double largest = 0.0, rms = 0.0;

  Errors(const Series& found, const Series& exact) {
    for (std::size_t i = 0; i < found.values.size(); ++i) {
      const double error = std::abs(found.values[i] - exact.values[i]) / std::max(1.0, std::abs(exact.values[i]));
      largest = std::max(largest, error);
      rms += error * error / static_cast<double>(found.values.size());
    }
    rms = std::sqrt(rms);
  }
};

template <class Run>
void compare(const char* what, const char* unit, double scale, int repeat, Run run) {
  std::array<std::vector<double>, 3> times;
  std::array<Series, 3> series;
  for (int i = 0; i < repeat; ++i)
    for (std::size_t tier = 0; tier < 3; ++tier) {
      series[tier] = run(transition_names[tier].tier);
      times[tier].push_back(series[tier].time);
    }
  for (std::size_t tier = 0; tier < 3; ++tier) {
    const Errors errors(series[tier], series[0]);
    fmt::print("{:22} {:20} {:8.3g} {}   error {:.2g} rms, {:.2g} largest\n", what, transition_names[tier].name,
               scale * median(times[tier]), unit, errors.rms, errors.largest);
  }
}

}  // namespace

int main(int argc, char** argv) {
  int repeat = 9;
  CLI::App app{"Transition functions side by side: error and time"};
  app.add_option("--repeat", repeat, "runs of which the median is taken");
  CLI11_PARSE(app, argc, argv);
  const PolygonSoup soup{{{-1.5, -1.5, 0}, {1.5, -1.5, 0}, {1.5, 1.5, 0}, {-1.5, 1.5, 0}}, {{0, 1, 2, 3}}};
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const Target plate(loaded.mesh);
  compare("F", "ns", 1e9, repeat, transition_series);
  compare("G_h of a strip", "ns", 1e9, repeat, kernel_series);
  compare("edge pass on a plate", "us", 1e6, repeat, [&](TransitionTier tier) { return plate_series(plate, tier); });
}
