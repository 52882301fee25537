#include "utd/interaction/edge_face_interaction.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/threads.h"
#include "scene/frequency_bands.h"
#include "utd/interaction/illuminated_faces.h"
#include "utd/interaction/penumbra_fringe.h"

namespace raytube {

namespace {

// Fringe currents of edges lit by a reflection: the third order no longer shows.
constexpr FringeOptions reflected_fringe{.order = 2, .receiver_shadow = false, .continue_by_images = true};
// The rules along the rays err by 1e-4 wavelengths: quadrature over the azimuth need not do better, and the estimate of its error
// begins with that (measured: docs/theory/interaction_accuracy.md).
constexpr double least_tolerance = 1e-4;
// Pairs scatter this share of what is expected of them, root mean square, where none was computed to tell it, and are taken to
// scatter the second one at least (set by two boxes: docs/theory/interaction.md).
constexpr double typical_share = 4.0, least_share = 0.1;
// Sums of pieces of edges that wait to be added up in order take so many matrices, a megabyte, or those of one piece.
constexpr std::size_t most_waiting = 16384;

// What a look finds: its sum, or piece by piece what has a place of its own in an image.
struct Found {
  InteractionApart apart;
  InteractionResult result{};
  std::vector<ImageEdge> pieces{};
  std::vector<double> squares{};  // per frequency: sum over what was illuminated of the largest |S_pq|^2 [m^2]

  void add(const LitEdgePiece& piece, std::span<const ScatteringMatrix> s) {
    const EdgeAxis& axis = *piece.edge;
    if (apart != InteractionApart::none)
      pieces.push_back({axis.origin + piece.from * axis.tangent, axis.origin + piece.to * axis.tangent, s.front()});
    else
      for (std::size_t f = 0; f < s.size(); ++f) result.scattering[f] += s[f];
  }
};

double largest(const ScatteringMatrix& s) {
  double most = 0.0;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) most = std::max(most, std::abs(s.at(p, q)));
  return most;
}

IlluminatedFaces illuminated(const EdgeLight& light, const LitJob& job, double tolerance, bool by_path) {
  const InteractionScene& scene = light.scene;
  ReceivingFaces faces = scene.faces;
  faces.first_met = scene.plan.patches(light.axis_of(*job.piece));
  std::vector<AzimuthRange> azimuths;
  for (const std::uint32_t patch : faces.first_met)
    azimuths.push_back(azimuths_of(*job.piece->edge, scene.faces.tree.mesh(), patch, scene.extents[patch]));
  const PathPlace place = light.place_of(job);
  return illuminated_faces(faces, light.look, light.wavenumbers, *job.piece,
                           {job.reflections, tolerance, azimuths, by_path ? &place : nullptr});
}

void add(const LitJob& job, const IlluminatedFaces& part, Found& found) {
  InteractionResult& result = found.result;
  result.work += part.work;
  for (std::size_t f = 0; f < part.scattering.size(); ++f) found.squares[f] += std::pow(largest(part.scattering[f]), 2);
  for (ChannelErrors& error : result.error)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) error[p][q] += part.error[p][q];
  if (found.apart == InteractionApart::by_path)
    std::ranges::copy(part.pieces, std::back_inserter(found.pieces));
  else
    found.add(*job.piece, part.scattering);
}

// Side by side, a few at a time; added up in order.
void illuminate(const EdgeLight& light, double tolerance, Found& found) {
  const double least = least_tolerance * light.wavelength;
  const double each = std::max(tolerance, least) / std::sqrt(static_cast<double>(light.jobs.size()));
  for (ChannelErrors& error : found.result.error)
    for (auto& row : error) row.fill(least);
  const std::size_t at_a_time = 1 + most_waiting / light.wavenumbers.size();
  std::vector<IlluminatedFaces> parts;
  for (std::size_t first = 0; first < light.jobs.size(); first += at_a_time) {
    const std::span jobs = std::span(light.jobs).subspan(first, std::min(at_a_time, light.jobs.size() - first));
    parts.resize(jobs.size());
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t i) {
      parts[i] = illuminated(light, jobs[i], each, found.apart == InteractionApart::by_path);
    });
    stop_if_cancelled();
    for (std::size_t i = 0; i < jobs.size(); ++i) add(jobs[i], parts[i], found);
  }
}

// What counts of reflected light by geometrical optics: all of it, none, and half on the border of its beam, where the wave that
// goes on from there has no side. Less the share that counts.
double beyond_smooth_light(const EdgeLight& light, const LitEdgePiece& piece, const PenumbraFringe& penumbra) {
  // Light that differs by more from that on its border is within 1e-5 rad of the border only of edges 500 of their lengths away:
  // waves are not asked then, which saves time alone.
  constexpr double near_border = 0.1;
  if (piece.light == 1.0) return 0.0;
  const auto ends_light = [&](const LitJob& job) { return job.has_penumbra() && penumbra.ends_along(piece, *job.piece); };
  const bool on_border = std::abs(piece.light - 0.5) < near_border && std::ranges::any_of(light.jobs, ends_light);
  const double sharp = on_border ? 0.5 : piece.light > 0.5 ? 1.0 : 0.0;
  return piece.weight / piece.light * (sharp - piece.light);
}

// The fringe currents on the rims of other faces, by waves of edges that light reaches after one reflection at most.
void add_penumbra(const EdgeLight& light, Found& found) {
  const InteractionScene& scene = light.scene;
  PenumbraFringe penumbra(scene.edges.tracer, scene.faces.tree, scene.axes, scene.shortest_axis, light.look, light.wavenumbers,
                          scene.plan);
  for (const LitJob& job : light.jobs) {
    if (!job.has_penumbra()) continue;
    const LitEdgePiece& piece = *job.piece;
    std::vector<ScatteringMatrix> sums(light.wavenumbers.size());
    const std::size_t first = found.pieces.size();
    const bool by_path = found.apart == InteractionApart::by_path;
    by_path ? penumbra.take_apart(piece, light.place_of(job), found.pieces) : penumbra.add(piece, sums);
    penumbra.add_step(piece, beyond_smooth_light(light, piece, penumbra), sums);
    for (ImageEdge& of_wave : std::span(found.pieces).subspan(first)) of_wave.s = piece.of_transmitter(of_wave.s, 0);
    for (std::size_t f = 0; f < sums.size(); ++f) sums[f] = piece.of_transmitter(sums[f], f);
    if (by_path) {
      const dvec3 middle = piece.edge->origin + 0.5 * (piece.from + piece.to) * piece.edge->tangent;
      const double phase = glm::dot(light.look.scattered - piece.wave->direction, middle) - piece.wave->path;
      const dvec3 at = light.place_of(job).at(middle, middle, phase);
      found.pieces.push_back({at, at, sums.front()});
    } else {
      found.add(piece, sums);
    }
  }
  found.result.work += penumbra.work();
}

// The fringe currents of edges lit by waves reflected once.
void add_fringe(const EdgeLight& light, std::span<const double> frequencies, Found& found) {
  const auto sum_of = [&](std::span<const ReflectedLook> looks) {
    EdgeLookResult sum = reflected_fringe_scattering(light.scene.edges, looks, frequencies, reflected_fringe);
    found.result.work += sum.work;
    for (std::size_t f = 0; f < frequencies.size(); ++f) sum.scattering[f] += sum.higher[f];
    return std::move(sum.scattering);
  };
  std::vector<ReflectedLook> all;
  for (const ReflectedWave& wave : light.reflected) {
    if (wave.patches.size() != 1) continue;
    const std::vector<ReflectedLook> looks = light.looks_of(wave, wave.lit);
    if (found.apart == InteractionApart::none) std::ranges::copy(looks, std::back_inserter(all));
    if (found.apart == InteractionApart::by_edges)
      for (const LitEdgePiece& piece : wave.lit) found.add(piece, sum_of(light.looks_of(wave, {&piece, 1})));
    if (found.apart == InteractionApart::by_path)
      for (const ReflectedLook& look : looks)
        std::ranges::copy(
            reflected_fringe_pieces(light.scene.edges, look, frequencies, reflected_fringe, light.place_of(wave.patches)),
            std::back_inserter(found.pieces));
  }
  if (found.apart != InteractionApart::none) return;
  const std::vector<ScatteringMatrix> sums = sum_of(all);
  for (std::size_t f = 0; f < frequencies.size(); ++f) found.result.scattering[f] += sums[f];
}

// What pairs leave out is taken to be as large a share of what is expected of them, root mean square, as with those computed.
void estimate_left_out(const EdgeLight& light, Found& found) {
  const PairPlan& plan = light.scene.plan;
  if (plan.left_out() == 0) return;
  double expected = 0.0;
  for (const LitJob& job : light.jobs)
    expected += plan.expected(light.axis_of(*job.piece)) * (job.piece->to - job.piece->from) / job.piece->edge->length;
  for (std::size_t f = 0; f < light.wavenumbers.size(); ++f) {
    const double wavelength = 2 * pi / light.wavenumbers[f];
    const double known = expected > 0.0 ? std::sqrt(found.squares[f] / (expected * wavelength)) : typical_share;
    found.result.left_out.push_back(std::max(least_share, known) * std::sqrt(plan.expected_of_left_out() * wavelength));
  }
}

Found found_in(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
               const InteractionOptions& options, InteractionApart apart) {
  Found found{apart};
  if (scene.axes.empty()) return found;
  const EdgeLight light(scene, look, frequencies, options.antennas);
  InteractionResult& result = found.result;
  result.pairs = scene.plan.pairs(), result.pairs_left_out = scene.plan.left_out();
  result.reflected_pairs_left_out = light.pairs_left_out, result.work = light.work;
  if (light.jobs.empty() && scene.plan.left_out() == 0) return found;
  result.illuminating_pieces = light.jobs.size();
  result.scattering.resize(frequencies.size()), result.error.resize(frequencies.size());
  found.squares.resize(frequencies.size());
  illuminate(light, options.tolerance, found);
  if (options.order > 1) add_penumbra(light, found), add_fringe(light, frequencies, found);
  estimate_left_out(light, found);
  return found;
}

}  // namespace

InteractionResult interaction_scattering(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                         const InteractionOptions& options) {
  return found_in(scene, look, frequencies, options, InteractionApart::none).result;
}

std::vector<ImageEdge> interaction_pieces(const InteractionScene& scene, const Look& look, double frequency,
                                          const InteractionOptions& options, InteractionApart apart) {
  return found_in(scene, look, {&frequency, 1}, options, apart).pieces;
}

double interaction_bytes(std::size_t frequencies) {
  constexpr double points_at_a_time = 50.0;  // the longest Gauss rule has 48 points, and two sums come to these
  const auto all = static_cast<double>(frequencies);
  return (static_cast<double>(most_waiting) + all * (1.0 + points_at_a_time)) * sizeof(ScatteringMatrix);
}

}  // namespace raytube
