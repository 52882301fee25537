#include "utd/sheet/sheet_strips.h"

#include <algorithm>
#include <cmath>

#include "utd/wedge/work.h"

namespace raytube {

namespace {

// Per launched wave of a half plane.
using CurrentWaves = std::vector<Complex>;

CurrentWaves launched(const SheetHalfPlane& half_plane, std::span<const SheetSource> sources, const EdgeConstants& constants) {
  CurrentWaves amplitudes;
  for (const LaunchedWave& wave : half_plane.launched())
    amplitudes.push_back(wave.weight * half_plane.bracket(sources, constants, wave.channel, wave.wave));
  return amplitudes;
}

// What is left of waves at the end of a strip, beside its phase e^{-jkl}.
CurrentWaves along_strip(const SheetHalfPlane& half_plane, double electrical_length) {
  CurrentWaves factors;
  for (const LaunchedWave& wave : half_plane.launched())
    factors.push_back(std::exp(-imaginary_unit * electrical_length * (wave.along - 1.0)));
  return factors;
}

void multiply(CurrentWaves& waves, const CurrentWaves& factors) {
  for (std::size_t n = 0; n < waves.size(); ++n) waves[n] *= factors[n];
}

// Sums of the arrived waves' own, by their amplitudes.
CurrentWaves combine(const std::vector<CurrentWaves>& of_unit, const CurrentWaves& amplitudes) {
  CurrentWaves sum(of_unit.empty() ? 0 : of_unit[0].size());
  for (std::size_t n = 0; n < of_unit.size(); ++n)
    for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += of_unit[n][m] * amplitudes[n];
  return sum;
}

// On strips e^{-jkl sin_cone^2 (along - 1)} at both rims; `cones` is (sin_cone there / here)^2 of the rim before.
Complex cosine_along_strip(const SheetHalfPlane& here, double cones, Complex along) {
  return here.sin_cone() * (1.0 + cones * (along - 1.0));
}

// What a wave of the cosine v would add beyond the rim, per its current.
Complex tail(Complex v, Complex nu) { return imaginary_unit / (v + nu); }

}  // namespace

/// One sheet of a plate at one frequency.
struct SheetStrips::Sheet {
  const SheetPair& pair;
  bool electric;
  double wavenumber, shortest;
};

/// Waves that leave a rim over the strips of a wave of the tree: of each of their points, or one for all.
struct SheetStrips::Departure {
  std::uint32_t wave;
  const SheetHalfPlane& half_plane;
  std::uint32_t first_point;
  std::vector<std::array<CurrentWaves, 2>> amplitudes;  // [point][transmit]

  const std::array<CurrentWaves, 2>& at(std::uint32_t point) const {
    return amplitudes[amplitudes.size() == 1 ? 0 : point - first_point];
  }
};

/// What one unit current wave that arrives at a rim makes there.
struct SheetStrips::ArrivedWave {
  const LaunchedWave& launched;
  Complex along_strip;  // cosine at the rim with which it changes along the strips as it did from where they start
  std::array<SheetSource, 1> source;
  EdgeConstants constants;

  ArrivedWave(const LaunchedWave& wave, double cones, const SheetHalfPlane& there, double b)
      : launched(wave),
        along_strip(cosine_along_strip(there, cones, wave.along)),
        source{there.arriving(wave.channel, wave.wave.a2, along_strip)},
        constants(there.constants(source, b)) {}
};

SheetStrips::SheetStrips(const SheetScene& scene, const LookVectors& look, double shortest_wavelength,
                         SheetHalfPlanes& half_planes)
    : scene_(scene),
      look_(look),
      half_planes_(half_planes),
      tree_(scene.wedges, scene.outlines, nullptr, look.incident, look.scattered, false),
      panels_(shortest_wavelength) {}

void SheetStrips::lay(std::uint32_t index, const FaceIncidence& incidence, std::span<const LitInterval> lit, int order) {
  tree_.grow(first_wave(scene_.wedges, index, 0, incidence, look_.incident, order), lit);
  panels_.lay(tree_, lit, scene_.wedges[index].length());
  work_ += tree_.work();
  shortest_ = std::numeric_limits<double>::infinity();
  for (const TreeWave& wave : tree_.waves())
    for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
      const StripBundle& strips = tree_.bundles()[b];
      const double sine = wave.wave.incidence.sin_cone;
      if (strips.edge) shortest_ = std::min(shortest_, strips.length_at(0.5 * (strips.from + strips.to)) * sine * sine);
    }
}

void SheetStrips::add(const RimLook& rim, double c, const SheetPair& pair, double wavenumber, ScatteringMatrix& sum) {
  for (const bool electric : {true, false}) {
    if ((electric ? pair.electric : pair.magnetic).empty()) continue;
    const SheetHalfPlane& sheet = half_planes_.at(pair, electric, rim.sin_cone, shortest(wavenumber));
    std::array<CurrentWaves, 2> amplitudes;
    for (int transmit = 0; transmit < 2; ++transmit) {
      const std::array<SheetSource, 2> sources = sheet.plane_wave(c, rim.b, driving_field(rim, look_, electric, transmit));
      amplitudes[transmit] = launched(sheet, sources, sheet.constants(sources, rim.b));
    }
    follow({pair, electric, wavenumber, shortest(wavenumber)}, {0, sheet, 0, {amplitudes}}, sum);
  }
}

// To the ends of all strips of a wave that are rims of the plate.
void SheetStrips::follow(const Sheet& sheet, const Departure& from, ScatteringMatrix& sum) {
  const TreeWave& wave = tree_.waves()[from.wave];
  for (std::uint32_t b = wave.first_bundle; b < wave.end_bundle; ++b) {
    const OutlineEdge* edge = tree_.bundles()[b].edge;
    if (!edge || edge->wedge == no_index || !is_sheet_rim(scene_.wedges[edge->wedge], scene_.materials)) continue;
    const std::span<const TreeWave> waves = tree_.waves();
    const auto next = std::ranges::find_if(waves, [&](const TreeWave& w) {
      return w.parent == b && w.wave.face == edge->wedge_face && w.wave.wedge == edge->wedge;
    });
    if (next != waves.end()) arrive(sheet, from, b, static_cast<std::uint32_t>(next - waves.begin()), sum);
  }
}

// The sine between strip and edge, in the product of current and length of edge, changes from that at the start to that at the
// end. Strips whose phases differ by less than 1e-6 rad are alike.
void SheetStrips::arrive(const Sheet& sheet, const Departure& from, std::uint32_t bundle, std::uint32_t next,
                         ScatteringMatrix& sum) {
  const StripBundle& strips = tree_.bundles()[bundle];
  const StripWave& there = tree_.waves()[next].wave;
  const RimLook rim(scene_.wedges[there.wedge].faces[there.face], there.incidence, look_.scattered);
  const SheetHalfPlane& half_plane = half_planes_.at(sheet.pair, sheet.electric, rim.sin_cone, sheet.shortest);
  std::vector<ArrivedWave> waves;
  const double cones = std::pow(from.half_plane.sin_cone() / half_plane.sin_cone(), 2);
  for (const LaunchedWave& wave : from.half_plane.launched()) waves.emplace_back(wave, cones, half_plane, rim.b);
  const EdgePanels::PointRange range = panels_.ranges()[bundle];
  const double sine = from.half_plane.sin_cone(), per_length = sheet.wavenumber * sine * sine;
  const bool alike = from.amplitudes.size() == 1 && per_length * std::abs(strips.growth) * (strips.to - strips.from) < 1e-6;
  Departure onwards{next, half_plane, range.first, {}};
  for (std::uint32_t i = range.first; i < range.end; ++i) {
    if (alike && i > range.first) break;
    onwards.amplitudes.push_back(from.at(i));
    const CurrentWaves left = along_strip(from.half_plane, per_length * strips.length_at(panels_.points()[i].arc_length));
    for (CurrentWaves& amplitudes : onwards.amplitudes.back()) multiply(amplitudes, left);
  }
  if (onwards.amplitudes.empty()) return;
  const StripWave& here = tree_.waves()[from.wave].wave;
  const RimLook start(scene_.wedges[here.wedge].faces[here.face], here.incidence, look_.scattered);
  radiate(sheet, start, rim, waves, onwards, bundle, skew_window(rim.sin_cone) * sine / rim.sin_cone, sum);
  work_ += work::sheet_wave * static_cast<double>(waves.size() * (1 + onwards.amplitudes.size()));
  if (!tree_.waves()[next].wave.goes_on()) return;
  std::vector<CurrentWaves> sent;
  for (const ArrivedWave& one : waves) sent.push_back(launched(half_plane, one.source, one.constants));
  for (auto& both : onwards.amplitudes)
    for (CurrentWaves& amplitudes : both) {
      amplitudes = combine(sent, amplitudes);
      for (Complex& each : amplitudes) each *= skew_window(rim.sin_cone) * sine / rim.sin_cone;
    }
  follow(sheet, onwards, sum);
}

// The moments have in them what the waves would add beyond the rim, as waves at that rim; in its place goes that of the strips,
// which is in the current of the rim before: along the strips, where that one has its observer.
std::vector<Received> SheetStrips::of_unit_waves(const Sheet& sheet, const RimLook& from, const RimLook& rim,
                                                 std::span<const ArrivedWave> waves, const SheetHalfPlane& here) const {
  const double cones = std::pow(from.sin_cone / rim.sin_cone, 2);
  const Complex onwards = -cosine_along_strip(here, cones, from.nu / from.sin_cone);
  std::vector<Received> received_of;
  const auto add = [&](const SheetVector& at_rim, const SheetVector& beyond) {
    const Received a = received(at_rim, rim, look_, sheet.electric), b = received(beyond, from, look_, sheet.electric);
    received_of.push_back({a[0] + b[0], a[1] + b[1]});
  };
  for (const ArrivedWave& wave : waves) {
    const SheetWave &before = wave.launched.wave, &at = wave.source[0].wave;
    const SheetChannel channel = wave.launched.channel;
    add(here.moment(wave.source, wave.constants, rim.nu, rim.b) - tail(at.nu, rim.nu) * current_of(channel, -at.nu, at.a2, rim.b),
        tail(wave.along_strip, onwards) * current_of(channel, before.nu, before.a2, from.b));
  }
  return received_of;
}

void SheetStrips::radiate(const Sheet& sheet, const RimLook& from, const RimLook& rim, std::span<const ArrivedWave> waves,
                          const Departure& arriving, std::uint32_t bundle, double sines, ScatteringMatrix& sum) const {
  const StripBundle& strips = tree_.bundles()[bundle];
  const std::vector<Received> of_unit = of_unit_waves(sheet, from, rim, waves, arriving.half_plane);
  const EdgePanels::PointRange range = panels_.ranges()[bundle];
  for (std::uint32_t i = range.first; i < range.end; ++i) {
    const PanelPoint& point = panels_.points()[i];
    const Complex phase =
        sheet.pair.current_share * sines * std::polar(point.weight, sheet.wavenumber * strips.end_path.at(point.arc_length));
    for (int transmit = 0; transmit < 2; ++transmit)
      for (std::size_t n = 0; n < of_unit.size(); ++n)
        for (int receive = 0; receive < 2; ++receive)
          sum.at(receive, transmit) += phase * arriving.at(i)[transmit][n] * of_unit[n][receive];
  }
}

}  // namespace raytube
