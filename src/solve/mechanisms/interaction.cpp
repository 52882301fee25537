#include "solve/mechanisms/interaction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mesh/model/geometry.h"
#include "plan/phase_reference.h"
#include "sbr/beams/tolerances.h"
#include "scene/frequency_bands.h"
#include "uncertainty/omissions.h"
#include "utd/fringe/near_pieces.h"
#include "utd/interaction/illumination_rounds.h"
#include "utd/interaction/interaction_groups.h"
#include "utd/interaction/reflected_light.h"

namespace raytube {

namespace {

constexpr const char* pairs_of_edge_and_face = "pairs of edge and face";

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

// Counted work of tubes and edges in a look, of each patch and each edge, at one frequency: of vehicles about that
// (utd/wedge/work.h).
constexpr double work_of_patch = 5e3, work_of_edge = 3e4;

// S of a body that scatters all round what its surface intercepts on average over all directions, a quarter of its area if it is
// convex (Cauchy) [m]. It hangs on no row and no look.
double isotropic_level(const TriangleMesh& mesh) {
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) area += 0.5 * glm::length(area_vector(mesh.vertices, t));
  return std::sqrt(area / 4.0 / (4.0 * pi));
}

class Interaction : public Mechanism {
 public:
  Interaction(const BandScene& scene, std::vector<bool> frequencies)
      : scene_(scene), frequencies_(std::move(frequencies)), limits_(interaction_limits(scene.plan)) {
    if (scene.plan.edges.interaction.forced()) return;
    const std::vector<double> reach = scene.edges.interaction_reach(limits_);
    reach_ = std::ranges::max(reach);
    for (std::size_t f = 0; f < reach.size(); ++f) frequencies_[f] = frequencies_[f] && reach[f] >= least_reach;
  }

  Prospect prospect(const TracedLook&) const override {
    if (scene_.plan.edges.interaction.forced()) return {};
    return {.reach = reach_};
  }

  Contribution solve(const TracedLook& traced, const std::vector<bool>&, LookSink& sink) const override {
    const std::optional<AntennaPair> pair = near_pair(traced.look);
    if (!pair) return solve(traced.look, nullptr, sink);
    const NearAntennas antennas = near_antennas(*pair);
    return solve(traced.look, &antennas, sink);
  }

 private:
  Contribution solve(const Look& look, const NearAntennas* antennas, LookSink& sink) const {
    InteractionLimits limits = limits_;
    limits.antennas = antennas;
    const bool refer = !look.far() && antennas == nullptr;
    if (sink.image) return add_pieces(look, limits, refer, *sink.image), Contribution();  // nobody asks for their sum
    InteractionResult found = scene_.edges.interaction(look, limits);
    if (refer) refer_to_antennas(look, found);
    return contribution_of(std::move(found));
  }

  void add_pieces(const Look& look, const InteractionLimits& limits, bool refer, ImageRequest& image) const {
    const std::size_t f = image.frequency_index;
    for (ImageEdge& piece : scene_.edges.interaction_pieces(look, f, limits, image.by_path)) {
      if (refer) piece.s *= factor_of_antennas(look, f);
      add_cut_up(piece, image);
    }
  }

  Contribution contribution_of(InteractionResult found) const {
    const InteractionSkips& skipped = found.skipped;
    const bool is_dark = found.scattering.empty();
    return {
        .s = {std::move(found.scattering)},
        .error = std::move(found.error),
        .missing = std::move(found.left_out),
        .ran = frequencies_,
        .work = found.work,
        .counts = {{.what = "edge_illumination_pieces", .count = found.illuminating_pieces},
                   {.what = "interaction_pairs", .count = found.pairs},
                   {pairs_of_edge_and_face, "too weak to matter", skipped.weak_pairs},
                   {pairs_of_edge_and_face, beyond_budget, skipped.pairs},
                   {"pairs of edge and mirror", beyond_budget, skipped.reflected_pairs},
                   {"edges lit after a reflection, without fringe currents", beyond_budget, skipped.fringe_pieces},
                   {"looks without edge-face interaction", "no lit edge faces another surface", is_dark ? 1u : 0u, Fold::least}}};
  }

  // Antennas near enough for their waves not to be plane all over the target.
  std::optional<AntennaPair> near_pair(const Look& look) const {
    if (look.far()) return std::nullopt;
    const TriangleMesh& mesh = scene_.plan.target.mesh;
    const AntennaPair pair(look, scene_.plan.sweep.radar, mesh.center);
    const double k = wavenumber(sampling_frequency(scene_.band.frequencies));
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
  std::vector<bool> frequencies_;  // at which there is any, and the budget reaches enough of it
  InteractionLimits limits_;
  double reach_ = 1.0;
};

}  // namespace

std::unique_ptr<Mechanism> make_interaction(const BandScene& scene) {
  std::vector<bool> frequencies = scene.edges.interacting();
  if (std::ranges::find(frequencies, true) == frequencies.end()) return nullptr;
  return std::make_unique<Interaction>(scene, std::move(frequencies));
}

// Sheets end the waves of edges, and a budget that affords no pair is none.
void tell_interaction(const SolvePlan& plan, const Contribution& interaction, std::size_t frequency, RowEvidence& row) {
  row.interaction = interaction.at(0, frequency);
  if (!interaction.missing.empty()) row.left_out = interaction.missing[frequency];
  const bool sheets = std::ranges::any_of(plan.sweep.materials, &Material::transmits);
  const bool some_left_out = interaction.out_of_reach() || std::ranges::any_of(interaction.counts, [](const Count& each) {
                               return each.what == pairs_of_edge_and_face && each.why == beyond_budget && each.count > 0;
                             });
  const bool any = !interaction.s.empty() && !interaction.s.front().empty();
  const bool none_afforded = some_left_out && frobenius_norm(row.interaction) == 0.0;
  row.has_interaction = interaction.ran_at(frequency) && any && !none_afforded && !sheets;
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

InteractionLimits interaction_limits(const SolvePlan& plan) {
  const Target& target = plan.target;
  const auto edges = static_cast<double>(std::ranges::count_if(target.wedges, &Wedge::radiates));
  const double budget = plan.edges.interaction_budget,
               look = work_of_patch * static_cast<double>(target.mesh.patches.size()) + work_of_edge * edges;
  return {interaction_quadrature_error(relative_tolerance(plan.tubes.tolerance_db), isotropic_level(target.mesh)),
          budget < unlimited_interaction_budget ? budget * look : std::numeric_limits<double>::infinity(), nullptr,
          plan.edges.interaction.forced() ? 0.0 : least_reach};
}

}  // namespace raytube
