#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "plan/phase_reference.h"
#include "sbr/beams/tolerances.h"
#include "scene/frequency_bands.h"
#include "solve/mechanisms/band_scene.h"
#include "solve/mechanisms/list.h"
#include "uncertainty/omissions.h"
#include "utd/fringe/near_pieces.h"
#include "utd/interaction/interaction_groups.h"

namespace raytube {

namespace {

constexpr const char *pairs_of_edge_and_face = "pairs of edge and face", *count_of_pairs = "interaction_pairs";

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
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) area += 0.5 * mesh.twice_area(t);
  return std::sqrt(area / 4.0 / (4.0 * pi));
}

class Interaction : public Mechanism {
 public:
  explicit Interaction(const BandScene& scene)
      : scene_(scene),
        limits_{interaction_quadrature_error(relative_tolerance(scene.plan.tubes.tolerance_db),
                                             isotropic_level(scene.plan.target.mesh))} {
    for (const std::optional<double>& reach : scene.edges.interaction_reach()) {
      frequencies_.push_back(reach && *reach >= least_reach_of_interaction(scene.plan));
      reach_ = std::max(reach_, reach.value_or(0.0));
    }
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
    const bool is_dark = found.scattering.empty();
    return {
        .s = {std::move(found.scattering)},
        .error = std::move(found.error),
        .missing = std::move(found.left_out),
        .ran = frequencies_,
        .work = found.work,
        .counts = {{.what = "edge_illumination_pieces", .count = found.illuminating_pieces},
                   {.what = count_of_pairs, .count = found.pairs},
                   {pairs_of_edge_and_face, beyond_budget, found.pairs_left_out},
                   {"pairs of edge and mirror", beyond_budget, found.reflected_pairs_left_out},
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
  double reach_ = 0.0;
};

MechanismState state_of_interaction(const SolvePlan& plan) {
  if (!plan.edges.interaction.possible()) return without("edges.between is false");
  if (!plan.fringe()) return without(edge_currents_state(plan).why_not);
  if (std::ranges::none_of(plan.target.wedges, &Wedge::radiates))
    return without("the target has no convex edge between perfect conductors");
  if (plan.no_reflection()) return without(nothing_in_front);
  if (plan.edges.interaction_budget == 0.0) return misses("edges.between_budget is 0");
  const std::vector<double>& frequencies = plan.sweep.frequencies;
  const TooSmall small = too_small_to_interact(plan.target.mesh, plan.target.wedges, std::ranges::min(frequencies));
  const auto without_large = static_cast<std::uint64_t>(
      std::ranges::count_if(frequencies, [&](double frequency) { return wavelength(frequency) > small.longest; }));
  std::vector<Skipped> skipped{
      {"frequencies without edge-face interaction", "no edge of a wavelength sees a face of a wavelength squared", without_large},
      {"edges without edge-face interaction", "shorter than a wavelength at the lowest frequency", small.edges},
      {"faces without edge-face interaction", "smaller than a wavelength squared at the lowest frequency", small.faces}};
  std::erase_if(skipped, [](const Skipped& item) { return item.count == 0; });
  if (without_large == frequencies.size()) {
    MechanismState none = without("no edge is as long as a wavelength, or no face as wide");
    none.skipped = std::move(skipped);
    return none;
  }
  return {.on = true,
          .forced = plan.edges.interaction.forced(),
          .what = fmt::format("at most {:g} times the work of tubes and edges", plan.edges.interaction_budget),
          .when = "in looks where edges.between_budget reaches half of what is expected",
          .skipped = std::move(skipped)};
}

std::unique_ptr<Mechanism> make_interaction(const BandScene& scene) {
  const auto is_there = [](const std::optional<double>& reach) { return reach.has_value(); };
  if (std::ranges::none_of(scene.edges.interaction_reach(), is_there)) return nullptr;
  return std::make_unique<Interaction>(scene);
}

// Sheets end the waves of edges, and a budget that affords no pair is none.
void tell_interaction(const SolvePlan& plan, const Contribution& interaction, std::size_t frequency, RowEvidence& row) {
  row.interaction = interaction.at(0, frequency);
  if (!interaction.missing.empty()) row.left_out = std::hypot(row.left_out, interaction.missing[frequency]);
  const bool sheets = std::ranges::any_of(plan.sweep.materials, &Material::transmits);
  const bool some_left_out = interaction.out_of_reach() || std::ranges::any_of(interaction.counts, [](const Count& each) {
                               return each.what == pairs_of_edge_and_face && each.why == beyond_budget && each.count > 0;
                             });
  const bool any = !interaction.s.empty() && !interaction.s.front().empty();
  const bool none_afforded = some_left_out && frobenius_norm(row.interaction) == 0.0;
  row.has_interaction = interaction.ran_at(frequency) && any && !none_afforded && !sheets;
}

// The edges and faces of each set as edge-face interaction sees them, and which of them count at each frequency.
double bytes_of_target(const SolvePlan& plan) {
  const auto patches = static_cast<double>(plan.target.mesh.patches.size());
  const auto frequencies = static_cast<double>(plan.sweep.frequencies.size());
  double bytes = frequencies * (patches / 8 + sizeof(InteractionGroup));
  for (const WedgeSet& set : plan.wedge_sets) {
    const auto wedges = static_cast<double>(set.wedges->size());
    bytes += wedges * sizeof(EdgeAxis) + patches * (sizeof(PatchExtent) + sizeof(std::uint32_t)) +
             bytes_of_pairs(wedges * patches, interaction_work(plan));
  }
  return bytes;
}

double bytes_of_look(const SolvePlan& plan) {
  return interaction_bytes(plan.sweep.frequencies.size()) + static_cast<double>(plan.target.wedges.size()) * sizeof(LitEdgePiece);
}

constexpr double few_pairs = 1e4;  // of an edge and a face: of more than these the budget reaches too few
constexpr const char* no_interaction = "none; use a full-wave method where faces see one another";

// At most: where there is little to compute it takes less than it may.
std::string up_to_budget(const char* key, double budget) {
  return fmt::format("{}, at most {:.2g} times the time", key, 1.0 + budget);
}

// The budget for all pairs, taken to cost as much each as those that were computed: these are the strongest, and so not the
// cheapest. A look that leaves pairs out has spent its budget.
std::string larger_budget(double budget, const MechanismShown& shown) {
  std::uint64_t left = 0;
  for (const Count& count : shown.counts) left += count.why == beyond_budget ? count.count : 0;
  const std::uint64_t computed = count_named(shown.counts, count_of_pairs);
  if (left == 0 || computed == 0 || shown.left_out < worth_naming) return no_interaction;
  const double needed = std::ceil(budget * (1.0 + static_cast<double>(left) / static_cast<double>(computed)));
  const double factor = (1.0 + needed) / (1.0 + budget);
  if (factor > affordable) return no_interaction;
  return fmt::format("edges.between_budget = {:.0f}, about {:.2g} times the time", needed, factor);
}

std::string remedy_of_interaction(const SolvePlan& plan, const MechanismShown& shown) {
  const double budget = plan.edges.interaction_budget, usual = EdgeOptions{}.interaction_budget;
  const Target& target = plan.target;
  const double possible_pairs = static_cast<double>(target.wedges.size()) * static_cast<double>(target.mesh.patches.size());
  if (std::ranges::any_of(plan.sweep.materials, &Material::transmits)) return no_interaction;
  const bool is_off = !plan.fringe() || !plan.edges.interaction.possible() || budget == 0.0;
  if (is_off && possible_pairs > few_pairs) return no_interaction;
  if (!plan.fringe()) return more_edge_currents;
  if (!plan.edges.interaction.possible()) return up_to_budget("edges.between = true", budget);
  if (budget == 0.0) return up_to_budget(fmt::format("edges.between_budget = {}", usual).c_str(), usual);
  return larger_budget(budget, shown);
}

// Nothing that an edge diffracts is stronger than what it receives.
double bound_of_interaction(const AmplitudeLimits& limits) { return limits.surface; }

}  // namespace

bool interacts(const SolvePlan& plan, const BandPlan& band) {
  return !band.convexity.no_reflection && plan.state("interaction").on;
}

double least_reach_of_interaction(const SolvePlan& plan) { return plan.edges.interaction.forced() ? 0.0 : least_reach; }

double interaction_work(const SolvePlan& plan) {
  const Target& target = plan.target;
  const auto edges = static_cast<double>(std::ranges::count_if(target.wedges, &Wedge::radiates));
  const double budget = plan.edges.interaction_budget,
               look = work_of_patch * static_cast<double>(target.mesh.patches.size()) + work_of_edge * edges;
  return budget < unlimited_interaction_budget ? budget * look : std::numeric_limits<double>::infinity();
}

MechanismEntry interaction_entry() {
  return {.name = "interaction",
          .label = "edge-face interaction",
          .key = "edges.between",
          .budget_key = "edges.between_budget",
          .columns = {{"interaction", "edge-face interaction (edges.between)", bound_of_interaction}},
          .counts = {"edge_illumination_pieces", count_of_pairs},
          .state = state_of_interaction,
          .make = make_interaction,
          .bytes = bytes_of_target,
          .look_bytes = bytes_of_look,
          .budget = [](const SolvePlan& plan) { return plan.edges.interaction_budget; },
          .tell = tell_interaction,
          .remedies = {{Omission::interaction, remedy_of_interaction}}};
}

}  // namespace raytube
