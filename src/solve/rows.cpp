#include "solve/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "plan/admissible.h"
#include "plan/phase_reference.h"
#include "solve/mechanisms/list.h"
#include "solve/scheduler.h"
#include "uncertainty/remedies.h"

namespace raytube {

namespace {

// The mechanisms that have a bound each, in words.
const std::vector<BeyondBound> bounded_parts{
    {"edge-face interaction (edges.between)"},       {"edges, order 1"},   {"edges, orders 2 and 3 (edges.order)"},
    {"waves over curved surfaces (surfaces.waves)"}, {"the first bounce"}, {"later bounces"}};
constexpr std::size_t first_bounce = all_parts.size(), later_bounces = first_bounce + 1;  // behind those of Part

ScatteringMatrix scaled(ScatteringMatrix matrix, Complex factor) { return matrix *= factor; }

void add_errors(const std::vector<ChannelErrors>& errors, std::size_t frequency_index, ChannelErrors& sum) {
  if (errors.empty()) return;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) sum[p][q] += errors[frequency_index][p][q];
}

}  // namespace

RowCollector::RowCollector(const SolvePlan& plan, const ModelUncertainty& model, std::vector<double> edge_lengths)
    : plan_(plan),
      sweep_(plan.sweep),
      model_uncertainty_(model),
      first_(plan.looks.computed.size() + 1),
      following_(sweep_.looks.size()),
      sliver_areas_(plan.looks.computed.size()),
      model_squares_(plan.looks.computed.size()),
      interaction_left_out_(plan.looks.computed.size()),
      used_(mechanism_count),
      skipped_(plan.skips),
      bounds_(plan, std::move(edge_lengths)),
      beyond_bound_(bounded_parts) {
  for (const MechanismEntry& entry : mechanism_list()) states_.push_back(entry.state(plan));
  for (const LookSource& source : plan.looks.sources) ++first_[source.index + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next = first_;
  for (std::size_t i = 0; i < following_.size(); ++i) following_[next[plan.looks.sources[i].index]++] = i;
  result_.total.resize(sweep_.rows());
  result_.error.resize(sweep_.rows());
  result_.model.resize(sweep_.rows());
  result_.model_parts.resize(omissions);
  if (any_rough(sweep_.materials) && !plan.rays()) result_.incoherent.resize(sweep_.rows());
  if (!plan.keep_parts) return;
  for (ModelPart& part : result_.model_parts) part.rows.resize(sweep_.rows());
  for (std::vector<ScatteringMatrix>& part : result_.parts.of) part.resize(sweep_.rows());
}

void RowCollector::add(std::size_t index, const LookResult& look) {
  const std::vector<OmissionErrors> errors = model_uncertainty_.of(sweep_.looks[plan_.looks.computed[index]], look);
  const std::lock_guard lock(mutex_);
  count(index, look);
  for (std::size_t f = 0; f < errors.size(); ++f) add_model(index, f, errors[f]);
  for (std::size_t i = first_[index]; i < first_[index + 1]; ++i)
    add_rows(following_[i], look, plan_.looks.sources[following_[i]]);
}

// What was traced for a look.
void RowCollector::count_tubes(std::size_t index, const TubeSums& tubes) {
  Statistics& all = result_.statistics;
  all.tubes += tubes.tubes;
  all.rays += tubes.rays;
  all.lost_rays += tubes.lost_rays;
  if (tubes.lost_rays > 0) lost_rays_[index] = tubes.first_lost;
  add_look(all.truncated, tubes.truncated);
  sliver_areas_[index] = tubes.sliver_area;
  if (all.hits.size() < tubes.hits.size()) all.hits.resize(tubes.hits.size());
  for (std::size_t b = 0; b < tubes.hits.size(); ++b) all.hits[b] += tubes.hits[b];
  skipped_.empty_cells += tubes.empty_cells;
  skipped_.faces_away += tubes.faces_away;
}

void RowCollector::count(std::size_t index, const LookResult& look) {
  count_tubes(index, look.tubes);
  count_runs(look.others);
  skipped_ += look.others.skipped;
  interaction_pairs_ += look.others.interaction_pairs;
  for (const double left_out : look.others.left_out)
    interaction_left_out_[index] += static_cast<double>(first_[index + 1] - first_[index]) * left_out * left_out;
}

// How the mechanisms fared in a look.
void RowCollector::count_runs(const LookSums& look) {
  for (std::size_t i = 0; i < mechanism_count; ++i) {
    if (!states_[i].on) continue;
    const MechanismRun& run = look.runs[i];
    ++(run.ran.empty() || run.out_of_reach() ? used_[i].looks_without : used_[i].looks);
    used_[i].most_db = std::max(used_[i].most_db, run.most_db);
  }
  if (!states_[static_cast<std::size_t>(MechanismId::interaction)].on) return;
  const MechanismRun& interaction = look.run(MechanismId::interaction);
  if (interaction.out_of_reach()) {
    ++unreached_looks_;
    most_reach_ = std::max(most_reach_, interaction.reach > 0.0 ? interaction.reach : least_reach);
  } else if (look.s[Part::interaction].empty())
    ++dark_interaction_looks_;
}

// The same for every look that follows from this one.
void RowCollector::add_model(std::size_t index, std::size_t frequency_index, const OmissionErrors& errors) {
  const std::span following(following_.data() + first_[index], first_[index + 1] - first_[index]);
  std::array<double, omissions> squares{};
  for (std::size_t i = 0; i < omissions; ++i)
    if (const double square = co_polar_square(errors[i]); std::isfinite(square)) squares[i] = square;
  for (std::size_t i = 0; i < omissions; ++i) model_squares_[index][i] += static_cast<double>(following.size()) * squares[i];
  const auto largest = static_cast<std::size_t>(std::ranges::max_element(squares) - squares.begin());
  if (squares[largest] > 0.0) result_.model_parts[largest].rows_largest += following.size();
  for (const std::size_t look : following) {
    const std::size_t row = sweep_.row(look, frequency_index);
    result_.model[row] = root_sum_square(errors);
    for (std::size_t i = 0; plan_.keep_parts && i < omissions; ++i) result_.model_parts[i].rows[row] = errors[i];
  }
}

// In index order, so that sums do not depend on that of the looks.
void RowCollector::finish_model() {
  std::array<double, omissions> sums{};
  for (const std::array<double, omissions>& look : model_squares_)
    for (std::size_t part = 0; part < omissions; ++part) sums[part] += look[part];
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  const double left_out = std::accumulate(interaction_left_out_.begin(), interaction_left_out_.end(), 0.0);
  const double of_interaction = sums[static_cast<std::size_t>(Omission::interaction)];
  const Target& target = plan_.target;
  const RemedyEvidence evidence{plan_.edges,
                                plan_.tubes,
                                plan_.surfaces,
                                !sweep_.materials.empty(),
                                std::ranges::any_of(sweep_.materials, &Material::transmits),
                                model_uncertainty_.curved_edges(),
                                static_cast<double>(target.wedges.size()) * static_cast<double>(target.mesh.patches.size()),
                                skipped_,
                                result_.statistics.truncated,
                                result_.statistics.hits,
                                interaction_pairs_,
                                of_interaction > 0.0 ? left_out / of_interaction : 0.0,
                                used_[static_cast<std::size_t>(MechanismId::surface_waves)].looks_without};
  for (std::size_t i = 0; i < omissions; ++i) {
    const OmissionText& text = text_of(static_cast<Omission>(i));
    ModelPart& part = result_.model_parts[i];
    part.name = text.name, part.what = text.what;
    part.remedy = remedy_of(static_cast<Omission>(i), evidence);
    part.rms = std::sqrt(sums[i] / static_cast<double>(sweep_.rows()));
    part.share = all > 0.0 ? sums[i] / all : 0.0;
  }
  std::erase_if(result_.model_parts, [](const ModelPart& part) { return part.rms == 0.0; });
  std::ranges::stable_sort(result_.model_parts, std::ranges::greater{}, &ModelPart::share);
}

void RowCollector::add_rows(std::size_t look, const LookResult& part, const LookSource& source) {
  for (std::size_t f = 0; f < sweep_.frequencies.size(); ++f) add_row(look, f, part, source);
  if (!part.tubes.incoherent.empty())
    std::ranges::copy(part.tubes.incoherent, result_.incoherent.begin() + static_cast<std::ptrdiff_t>(sweep_.row(look, 0)));
  Statistics& all = result_.statistics;
  const LookSums& others = part.others;
  all.wedges_lit += others.wedges_lit;
  all.surface_strips += others.surface_strips;
  all.illuminating_pieces += others.illuminating_pieces;
  for (const bool windowed : others.windowed) all.windowed_rows += windowed ? 1 : 0;
  if (part.tubes.tubes == 0 && !plan_.rays()) ++looks_without_tubes_;
  if (plan_.fringe() && !others.edges_lit)
    ++(others.s[Part::edges_first].empty() ? skipped_.edgeless_looks : skipped_.unlit_looks);
}

void RowCollector::add_row(std::size_t look, std::size_t frequency_index, const LookResult& part, const LookSource& source) {
  const std::size_t row = sweep_.row(look, frequency_index);
  const Complex factor = to_mesh_origin(plan_.target.mesh, sweep_.looks[look], sweep_.frequencies[frequency_index]);
  const PhysicalBound bound = bounds_.of(sweep_.looks[look], frequency_index);
  result_.error[row] = part.tubes.error[frequency_index];
  for (std::size_t b = 0; b < part.tubes.bounces.size(); ++b) {
    const ScatteringMatrix bounce = scaled(from_source(part.tubes.bounces[b][frequency_index], source), factor);
    compare(b == 0 ? first_bounce : later_bounces, row, bounce, b == 0 ? bound.first_bounce : bound.later_bounces);
    result_.total[row] += bounce;
    if (!plan_.keep_parts) continue;
    if (result_.bounces.size() <= b) result_.bounces.emplace_back(sweep_.rows());
    result_.bounces[b][row] = bounce;
  }
  const LookSums& others = part.others;
  for (std::size_t i = 0; i < others.s.of.size(); ++i) {
    if (others.s.of[i].empty()) continue;
    const ScatteringMatrix s = scaled(from_source(others.s.of[i][frequency_index], source), factor);
    compare(i, row, s, bound.parts.of[i]);
    result_.total[row] += s;
    if (plan_.keep_parts) result_.parts.of[i][row] = s;
  }
  add_errors(others.error, frequency_index, result_.error[row]);
}

// Some parts reach their bound: physical optics of a plate, broadside.
constexpr double rounding = 1e-9;

// Rays and their edges have laws of their own. What is no number is beyond any bound.
void RowCollector::compare(std::size_t part, std::size_t row, const ScatteringMatrix& s, double bound) {
  const double largest = largest_amplitude(s);
  const bool finite = std::isfinite(frobenius_norm(s));
  const bool bounded = plan_.rays() || largest <= bound * (1.0 + rounding) || largest == 0.0;
  if (finite && bounded) return;
  BeyondBound& beyond = beyond_bound_[part];
  const double ratio = finite ? largest / bound : std::numeric_limits<double>::infinity();
  if (beyond.rows++ == 0 || ratio > beyond.ratio || (ratio == beyond.ratio && row < beyond.worst)) {
    beyond.ratio = ratio;
    beyond.worst = row;
  }
}

SweepResult RowCollector::finish() {
  finish_model();
  tell_lost_rays();
  Statistics& all = result_.statistics;
  all.sliver_area = std::accumulate(sliver_areas_.begin(), sliver_areas_.end(), 0.0);
  if (looks_without_tubes_) all.skipped.push_back({"tubes of a look", "the target has no projected area", looks_without_tubes_});
  all.skipped.insert(all.skipped.end(), plan_.skipped_wedges.begin(), plan_.skipped_wedges.end());
  if (plan_.tubes.skip && plan_.no_reflection() && !all.hits.empty()) skipped_.reflected_tubes = all.hits[0];
  for (const Skipped& item : skipped_items(skipped_)) all.skipped.push_back(item);
  tell_mechanisms();
  std::ranges::copy_if(beyond_bound_, std::back_inserter(all.beyond_bound),
                       [](const BeyondBound& each) { return each.rows > 0; });
  all.wedges = plan_.target.wedges.size();
  all.paths = plan_.rays();
  all.ray_range = plan_.ray_range;
  if (plan_.fringe()) count_thin_plate_edges();
  return std::move(result_);
}

// With the share, if it was known in all of these looks before interaction began.
std::string unreached_text(double most_reach) {
  const std::string text = "edges.between_budget reaches less than half of what is expected";
  return most_reach < least_reach ? text + fmt::format(" (about {:.2g} % at most)", 100.0 * most_reach) : text;
}

// Which took part, and what is without them.
void RowCollector::tell_mechanisms() {
  Statistics& all = result_.statistics;
  for (const MechanismEntry& entry : mechanism_list()) {
    const auto i = static_cast<std::size_t>(entry.id);
    const MechanismState& state = states_[i];
    MechanismUse& use = used_[i];
    use.name = name_of(entry.scatters), use.label = entry.label, use.key = entry.key, use.on = state.on,
    use.why_not = state.why_not;
    const std::string looks = std::string("looks without ") + entry.label;
    if (state.missed) all.skipped.push_back({looks, state.why_not, sweep_.looks.size()});
    std::ranges::copy(state.skipped, std::back_inserter(all.skipped));
    const bool is_interaction = entry.id == MechanismId::interaction;
    if (is_interaction && unreached_looks_ > 0) all.skipped.push_back({looks, unreached_text(most_reach_), unreached_looks_});
    if (is_interaction && dark_interaction_looks_ > 0)
      all.skipped.push_back({looks, "no lit edge faces another surface", dark_interaction_looks_});
    if (!is_interaction && !state.forced && use.looks_without > 0)
      all.skipped.push_back({looks,
                             fmt::format("too weak compared with the tubes for what they cost: expected to change a row by about "
                                         "{:.2g} dB at most, accuracy.tolerance_db "
                                         "is {:g}",
                                         use.most_db, plan_.tubes.tolerance_db),
                             use.looks_without});
  }
  all.mechanisms = std::move(used_);
}

void RowCollector::tell_lost_rays() {
  Statistics& all = result_.statistics;
  all.looks_with_lost_rays = lost_rays_.size();
  for (const auto& [index, rays] : lost_rays_)
    for (const LostRay& ray : rays) {
      if (all.first_lost_rays.size() == most_lost_rays_told) return;
      const std::size_t look = plan_.looks.computed[index];
      all.first_lost_rays.push_back({ray.at + plan_.target.mesh.center, ray.triangle, look, sweep_.looks[look].transmit});
    }
}

void RowCollector::count_thin_plate_edges() {
  const auto [lowest, highest] = std::ranges::minmax(sweep_.frequencies);
  result_.statistics.thin_plate_edges_lowest = count_thin(plan_.thin_plate_edges, lowest);
  result_.statistics.thin_plate_edges_highest = count_thin(plan_.thin_plate_edges, highest);
}

}  // namespace raytube
