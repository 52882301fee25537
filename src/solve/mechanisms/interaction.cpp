#include "solve/mechanisms/interaction.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "core/work.h"
#include "plan/phase_reference.h"
#include "sbr/beams/tolerances.h"
#include "utd/fringe/near_pieces.h"
#include "utd/interaction/illumination_rounds.h"
#include "utd/interaction/interaction_groups.h"
#include "utd/interaction/reflected_light.h"

namespace raytube {

namespace {

// Of the waves of an antenna, k a^2 / R, below which they are taken as plane all over the target [rad]: as much of what edges
// send on is lost at most (measured: docs/theory/finite_range.md).
constexpr double least_bend = 1e-3;

// Within a cell each, with a share of S by length.
void add_cut_up(const ImageEdge& piece, ImageRequest& image) {
  const std::vector<double> shares = image.lattice.crossings(piece.begin, piece.end);
  const dvec3 way = piece.end - piece.begin;
  for (std::size_t i = 1; i < shares.size(); ++i) {
    ScatteringMatrix part = piece.s;
    image.pieces.push_back({piece.begin + shares[i - 1] * way, piece.begin + shares[i] * way, part *= shares[i] - shares[i - 1]});
  }
}

// Amplitude that quadrature may leave [m].
double quadrature_tolerance(const SolvePlan& plan, const TubeSums& tubes) {
  double strongest = 0.0;
  for (std::size_t f = 0; !tubes.bounces.empty() && f < tubes.bounces[0].size(); ++f)
    strongest = std::max(strongest, frobenius_norm(tubes.total(f)));
  return interaction_quadrature_error(relative_tolerance(plan.tubes.tolerance_db), strongest);
}

class Interaction : public Mechanism {
 public:
  Interaction(const BandScene& scene, std::vector<bool> frequencies) : scene_(scene), frequencies_(std::move(frequencies)) {}

  Prospect prospect(const TracedLook& traced, const LookSums& others) const override {
    if (scene_.plan.edges.interaction.forced()) return {};
    return {.reach = scene_.edges.interaction_reach(interaction_limits(scene_.plan, traced.tubes, edge_work(others)))};
  }

  void solve(const TracedLook& traced, const std::vector<bool>&, LookSink& sink) const override {
    const std::optional<AntennaPair> pair = near_pair(traced.look);
    if (!pair) return solve(traced, nullptr, sink);
    const NearAntennas antennas = near_antennas(*pair);
    solve(traced, &antennas, sink);
  }

 private:
  void solve(const TracedLook& traced, const NearAntennas* antennas, LookSink& sink) const {
    const Look& look = traced.look;
    InteractionLimits limits = interaction_limits(scene_.plan, traced.tubes, edge_work(sink.sums));
    limits.antennas = antennas;
    InteractionResult found = scene_.edges.interaction(look, limits);
    const bool refer = !look.far() && antennas == nullptr;
    if (refer) refer_to_antennas(look, found);
    put(std::move(found), sink.sums);
    sink.sums.run(MechanismId::interaction).ran = frequencies_;
    if (sink.image == nullptr) return;
    const std::size_t f = sink.image->frequency_index;
    for (ImageEdge& piece : scene_.edges.interaction_pieces(look, f, limits, sink.image->by_path)) {
      if (refer) piece.s *= factor_of_antennas(look, f);
      add_cut_up(piece, *sink.image);
    }
  }

  static double edge_work(const LookSums& others) { return others.run(MechanismId::edge_currents).work; }

  static void put(InteractionResult found, LookSums& sums) {
    sums.run(MechanismId::interaction).work = found.work;
    if (found.unreached) sums.run(MechanismId::interaction).reach = 0.0;
    sums.s[Part::interaction] = std::move(found.scattering);
    sums.error = std::move(found.error);
    sums.left_out = std::move(found.left_out);
    sums.illuminating_pieces = found.illuminating_pieces;
    sums.interaction_pairs = found.pairs;
    sums.skipped.weak_pairs = found.skipped.weak_pairs;
    sums.skipped.pairs_beyond_budget = found.skipped.pairs;
    sums.skipped.reflections_beyond_budget = found.skipped.reflected_pairs;
    sums.skipped.fringe_beyond_budget = found.skipped.fringe_pieces;
  }

  // Antennas near enough for their waves not to be plane all over the target.
  std::optional<AntennaPair> near_pair(const Look& look) const {
    if (look.far()) return std::nullopt;
    const TriangleMesh& mesh = scene_.plan.target.mesh;
    const AntennaPair pair(look, scene_.plan.sweep.radar, mesh.center);
    const double k = wavenumber(std::ranges::max(scene_.band.frequencies));
    const auto plane = [&](const Antenna& antenna) { return bend_over_target(antenna, k, mesh.radius) < least_bend; };
    if (plane(pair.transmit) && plane(pair.receive)) return std::nullopt;
    return pair;
  }

  Complex factor_of_antennas(const Look& look, std::size_t f) const {
    return from_plane_waves(scene_.plan.target.mesh, look, scene_.plan.sweep.radar, scene_.band.frequencies[f]);
  }

  void refer_to_antennas(const Look& look, InteractionResult& found) const {
    for (std::size_t f = 0; f < found.scattering.size(); ++f) {
      const Complex factor = factor_of_antennas(look, f);
      found.scattering[f] *= factor;
      for (std::array<double, 2>& errors : found.error[f])
        for (double& error : errors) error *= std::abs(factor);
      if (!found.left_out.empty()) found.left_out[f] *= std::abs(factor);
    }
  }

  const BandScene& scene_;
  std::vector<bool> frequencies_;  // at which there is any
};

}  // namespace

std::unique_ptr<Mechanism> make_interaction(const BandScene& scene) {
  std::vector<bool> frequencies = scene.edges.interacting();
  if (std::ranges::find(frequencies, true) == frequencies.end()) return nullptr;
  return std::make_unique<Interaction>(scene, std::move(frequencies));
}

// The edges and faces of each set as edge-face interaction sees them, and which of them count at each frequency.
double interaction_bytes(const SolvePlan& plan) {
  const auto patches = static_cast<double>(plan.target.mesh.patches.size());
  const auto frequencies = static_cast<double>(plan.sweep.frequencies.size());
  double bytes = frequencies * (patches / 8 + sizeof(InteractionGroup));
  for (const WedgeSet& set : plan.wedge_sets)
    bytes += static_cast<double>(set.wedges->size()) * sizeof(EdgeAxis) + patches * (sizeof(PatchExtent) + sizeof(std::uint32_t));
  return bytes;
}

double interaction_look_bytes(const SolvePlan& plan) {
  const auto wedges = static_cast<double>(plan.target.wedges.size());
  const double pieces = wedges + 2.0 * most_reflected_pairs;
  return illumination_bytes(plan.sweep.frequencies.size(), pieces * static_cast<double>(plan.target.mesh.patches.size())) +
         wedges * sizeof(LitEdgePiece);
}

InteractionLimits interaction_limits(const SolvePlan& plan, const TubeSums& tubes, double edge_work) {
  const auto frequencies = static_cast<double>(tubes.error.size());
  const auto met = static_cast<double>(std::accumulate(tubes.hits.begin(), tubes.hits.end(), std::uint64_t{0}));
  const double tube_work = work::tube * static_cast<double>(tubes.tubes) + work::tube_ray * static_cast<double>(tubes.rays) +
                           work::tube_frequency * met * frequencies;
  const double budget = plan.edges.interaction_budget;
  const bool limited = budget < unlimited_interaction_budget;
  return {quadrature_tolerance(plan, tubes), limited ? budget * (tube_work + edge_work) : std::numeric_limits<double>::infinity(),
          plan.edges.interaction.forced() ? 0.0 : least_reach};
}

}  // namespace raytube
