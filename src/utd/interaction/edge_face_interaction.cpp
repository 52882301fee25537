#include "utd/interaction/edge_face_interaction.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/threads.h"
#include "utd/fringe/reflected_edges.h"
#include "utd/interaction/reflected_light.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

namespace {

constexpr int reflected_order = 2;        // of fringe currents by reflected light: the third order no longer shows
constexpr double least_tolerance = 1e-4;  // [wavelengths] the rules along the rays are no better; part of the estimate

// What one lit piece of an edge illuminates.
struct Job {
  const LitEdgePiece* piece;
  int reflections;
};

LitInterval along_wedge(const LitEdgePiece& piece) {
  const EdgeAxis& axis = *piece.edge;
  const double from = piece.from / axis.length, to = piece.to / axis.length;
  return axis.reversed() ? LitInterval{1.0 - to, 1.0 - from} : LitInterval{from, to};
}

ReflectedLook reflected_look(const ReflectedWave& wave, const LookVectors& look, const Wedge* first_wedge) {
  ReflectedLook result{look, wave.wave.path, {}};
  result.look.incident = wave.wave.direction;
  result.look.electric = wave.wave.electric;
  for (int q = 0; q < 2; ++q) result.look.magnetic[q] = glm::cross(wave.wave.direction, wave.wave.electric[q]);
  for (const LitEdgePiece& piece : wave.lit)
    result.edges.push_back({static_cast<std::uint32_t>(piece.edge->wedge - first_wedge), {along_wedge(piece)}, piece.weight});
  return result;
}

// All waves that light edges in one look, and what these radiate.
class InteractionLook {
 public:
  InteractionLook(const InteractionScene& scene, const Look& look, std::span<const double> frequencies)
      : scene_(scene), look_(look_vectors(look)), incident_{look_.incident, look_.electric, 0.0}, frequencies_(frequencies) {
    const double shortest = wavelength(std::ranges::max(frequencies));
    LitEdges edges(scene.edges.wedges, scene.edges.tracer, look_, shortest, false);
    for (const EdgeAxis& axis : scene.axes) add_direct_light(axis, edges);
    reflected_ = ReflectedLight(scene.faces, scene.axes, incident_, shortest).waves(most_reflections);
    for (const LitEdgePiece& piece : direct_) jobs_.push_back({&piece, most_reflections});
    for (const ReflectedWave& wave : reflected_)
      for (const LitEdgePiece& piece : wave.lit)
        jobs_.push_back({&piece, most_reflections - static_cast<int>(wave.patches.size())});
  }
  InteractionLook(const InteractionLook&) = delete;

  InteractionResult solve(const InteractionOptions& options) {
    InteractionResult result;
    if (jobs_.empty()) return result;
    result.scattering.resize(frequencies_.size());
    result.illuminating_pieces = jobs_.size();
    add_illuminated(options.tolerance, result);
    if (options.order > 1) add_fringe(options, result);
    return result;
  }

  std::vector<ImageEdge> pieces(const InteractionOptions& options, std::size_t frequency_index) const {
    std::vector<ImageEdge> result;
    const std::vector<IlluminatedFaces> parts = illuminate(options.tolerance);
    for (std::size_t i = 0; i < jobs_.size(); ++i)
      result.push_back(image_of(*jobs_[i].piece, parts[i].scattering[frequency_index]));
    if (options.order == 1) return result;
    for (const ReflectedWave& wave : reflected_) {
      if (wave.patches.size() != 1) continue;
      ReflectedLook look = reflected_look(wave, look_, scene_.edges.wedges.data());
      const std::vector<LitWedge> lit = std::exchange(look.edges, {});
      for (std::size_t i = 0; i < lit.size(); ++i) {
        look.edges = {lit[i]};
        const EdgeLookResult part = fringe(std::span(&look, 1), options);
        result.push_back(image_of(wave.lit[i], part.scattering[frequency_index] + part.higher[frequency_index]));
      }
    }
    return result;
  }

 private:
  static ImageEdge image_of(const LitEdgePiece& piece, const ScatteringMatrix& s) {
    const EdgeAxis& axis = *piece.edge;
    return {axis.origin + piece.from * axis.tangent, axis.origin + piece.to * axis.tangent, s};
  }

  void add_direct_light(const EdgeAxis& axis, LitEdges& edges) {
    const WedgeIncidence incidence = incidence_on(*axis.wedge, look_.incident);
    const double weight = incidence_weight(*axis.wedge, incidence);
    if (weight == 0.0 || !edges.find(static_cast<std::uint32_t>(axis.wedge - scene_.edges.wedges.data()), incidence)) return;
    for (const LitInterval& lit : edges.lit()) {
      const double from = axis.reversed() ? 1.0 - lit.end : lit.begin, to = axis.reversed() ? 1.0 - lit.begin : lit.end;
      direct_.push_back({&axis, &incident_, incidence.faces[0], from * axis.length, to * axis.length, weight});
    }
  }

  double least() const { return least_tolerance * wavelength(std::ranges::max(frequencies_)); }

  // Of every job, each integrated to its share of the tolerance.
  std::vector<IlluminatedFaces> illuminate(double tolerance) const {
    std::vector<double> wavenumbers;
    for (const double frequency : frequencies_) wavenumbers.push_back(wavenumber(frequency));
    const double share = std::max(tolerance, least()) / std::sqrt(static_cast<double>(jobs_.size()));
    std::vector<IlluminatedFaces> parts(jobs_.size());
    tbb::parallel_for(std::size_t{0}, jobs_.size(), [&](std::size_t i) {
      parts[i] = illuminated_faces(scene_.faces, look_, wavenumbers, *jobs_[i].piece, {jobs_[i].reflections, share});
    });
    stop_if_cancelled();
    return parts;
  }

  void add_illuminated(double tolerance, InteractionResult& result) const {
    ChannelErrors error{{{least(), least()}, {least(), least()}}};
    for (const IlluminatedFaces& part : illuminate(tolerance)) {
      for (std::size_t f = 0; f < frequencies_.size(); ++f) result.scattering[f] += part.scattering[f];
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) error[p][q] += part.error[p][q];
    }
    result.error.assign(frequencies_.size(), error);
  }

  void add_fringe(const InteractionOptions& options, InteractionResult& result) const {
    std::vector<ReflectedLook> looks;
    for (const ReflectedWave& wave : reflected_)
      if (wave.patches.size() == 1) looks.push_back(reflected_look(wave, look_, scene_.edges.wedges.data()));
    const EdgeLookResult sum = fringe(looks, options);
    for (std::size_t f = 0; f < frequencies_.size(); ++f) {
      result.scattering[f] += sum.scattering[f];
      result.scattering[f] += sum.higher[f];
    }
  }

  EdgeLookResult fringe(std::span<const ReflectedLook> looks, const InteractionOptions& options) const {
    return reflected_fringe_scattering(scene_.edges, looks, frequencies_, {reflected_order, false, options.transition, true});
  }

  const InteractionScene& scene_;
  LookVectors look_;
  PlaneWave incident_;
  std::span<const double> frequencies_;
  std::vector<LitEdgePiece> direct_;
  std::deque<ReflectedWave> reflected_;
  std::vector<Job> jobs_;
};

}  // namespace

InteractionResult interaction_scattering(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                         const InteractionOptions& options) {
  if (scene.axes.empty()) return {};
  return InteractionLook(scene, look, frequencies).solve(options);
}

std::vector<ImageEdge> interaction_pieces(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                          std::size_t frequency_index, const InteractionOptions& options) {
  if (scene.axes.empty()) return {};
  return InteractionLook(scene, look, frequencies).pieces(options, frequency_index);
}

}  // namespace raytube
