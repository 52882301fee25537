#include "solve/rows.h"

#include <algorithm>
#include <numeric>

#include "solve/phase_reference.h"

namespace raytube {

namespace {

ScatteringMatrix scaled(ScatteringMatrix matrix, Complex factor) { return matrix *= factor; }

}  // namespace

RowCollector::RowCollector(const SolvePlan& plan)
    : plan_(plan),
      sweep_(plan.sweep),
      first_(plan.looks.computed.size() + 1),
      following_(sweep_.looks.size()),
      sliver_areas_(plan.looks.computed.size()),
      skipped_(plan.skips) {
  for (const LookSource& source : plan.looks.sources) ++first_[source.index + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next = first_;
  for (std::size_t i = 0; i < following_.size(); ++i) following_[next[plan.looks.sources[i].index]++] = i;
  result_.total.resize(sweep_.rows());
  result_.error.resize(sweep_.rows());
  if (any_rough(sweep_.materials)) result_.incoherent.resize(sweep_.rows());
  if (!plan.keep_parts) return;
  result_.edges_first.resize(sweep_.rows());
  result_.edges_higher.resize(sweep_.rows());
  result_.interaction.resize(sweep_.rows());
}

void RowCollector::add(std::size_t index, const LookResult& look) {
  const std::lock_guard lock(mutex_);
  count(index, look);
  for (std::size_t i = first_[index]; i < first_[index + 1]; ++i)
    add_rows(following_[i], look, plan_.looks.sources[following_[i]]);
}

// What was traced for a look.
void RowCollector::count(std::size_t index, const LookResult& look) {
  Statistics& all = result_.statistics;
  all.tubes += look.tubes.tubes;
  all.rays += look.tubes.rays;
  all.lost_rays += look.tubes.lost_rays;
  all.tubes_truncated += look.tubes.tubes_truncated;
  sliver_areas_[index] = look.tubes.sliver_area;
  if (all.hits.size() < look.tubes.hits.size()) all.hits.resize(look.tubes.hits.size());
  for (std::size_t b = 0; b < look.tubes.hits.size(); ++b) all.hits[b] += look.tubes.hits[b];
  skipped_.empty_cells += look.tubes.empty_cells;
  skipped_.faces_away += look.tubes.faces_away;
  skipped_.weak_pairs += look.interaction.skipped.weak_pairs;
  skipped_.pairs_beyond_budget += look.interaction.skipped.pairs;
  skipped_.reflections_beyond_budget += look.interaction.skipped.reflected_pairs;
  skipped_.fringe_beyond_budget += look.interaction.skipped.fringe_pieces;
  if (plan_.mechanisms.interaction && plan_.skips.frequencies_without_large < sweep_.frequencies.size() &&
      look.interaction.scattering.empty())
    ++skipped_.dark_interaction_looks;
}

void RowCollector::add_rows(std::size_t look, const LookResult& part, const LookSource& source) {
  for (std::size_t f = 0; f < sweep_.frequencies.size(); ++f) add_row(look, f, part, source);
  if (!part.tubes.incoherent.empty())
    std::ranges::copy(part.tubes.incoherent, result_.incoherent.begin() + static_cast<std::ptrdiff_t>(sweep_.row(look, 0)));
  Statistics& all = result_.statistics;
  all.wedges_lit += part.edges.wedges_lit;
  all.illuminating_pieces += part.interaction.illuminating_pieces;
  for (const bool windowed : part.edges.windowed) all.windowed_rows += windowed ? 1 : 0;
  if (part.tubes.tubes == 0 && !plan_.mechanisms.rays) ++looks_without_tubes_;
  if (plan_.mechanisms.fringe && !part.edges.lit)
    ++(part.edges.scattering.empty() ? skipped_.edgeless_looks : skipped_.unlit_looks);
}

void RowCollector::add_row(std::size_t look, std::size_t frequency_index, const LookResult& part, const LookSource& source) {
  const std::size_t row = sweep_.row(look, frequency_index);
  const Complex factor = to_mesh_origin(plan_.target.mesh, sweep_.looks[look], sweep_.frequencies[frequency_index]);
  result_.error[row] = part.tubes.error[frequency_index];
  for (std::size_t b = 0; b < part.tubes.bounces.size(); ++b) {
    const ScatteringMatrix bounce = scaled(from_source(part.tubes.bounces[b][frequency_index], source), factor);
    result_.total[row] += bounce;
    if (!plan_.keep_parts) continue;
    if (result_.bounces.size() <= b) result_.bounces.emplace_back(sweep_.rows());
    result_.bounces[b][row] = bounce;
  }
  add_interaction(row, frequency_index, part, source, factor);
  if (part.edges.scattering.empty()) return;
  add_edges(row, scaled(from_source(part.edges.scattering[frequency_index], source), factor), result_.edges_first);
  if (part.edges.higher.empty()) return;
  add_edges(row, scaled(from_source(part.edges.higher[frequency_index], source), factor), result_.edges_higher);
}

void RowCollector::add_interaction(std::size_t row, std::size_t frequency_index, const LookResult& part, const LookSource& source,
                                   Complex factor) {
  if (part.interaction.scattering.empty()) return;
  add_edges(row, scaled(from_source(part.interaction.scattering[frequency_index], source), factor), result_.interaction);
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) result_.error[row][p][q] += part.interaction.error[frequency_index][p][q];
}

void RowCollector::add_edges(std::size_t row, const ScatteringMatrix& edges, std::vector<ScatteringMatrix>& part) {
  result_.total[row] += edges;
  if (plan_.keep_parts) part[row] = edges;
}

SweepResult RowCollector::finish() {
  Statistics& all = result_.statistics;
  all.sliver_area = std::accumulate(sliver_areas_.begin(), sliver_areas_.end(), 0.0);
  if (looks_without_tubes_) all.skipped.push_back({"tubes of a look", "the target has no projected area", looks_without_tubes_});
  all.skipped.insert(all.skipped.end(), plan_.skipped_wedges.begin(), plan_.skipped_wedges.end());
  if (plan_.tubes.skip && plan_.target.convexity.no_reflection && !all.hits.empty()) skipped_.reflected_tubes = all.hits[0];
  for (const Skipped& item : skipped_items(skipped_)) all.skipped.push_back(item);
  all.wedges = plan_.target.wedges.size();
  all.ray_range = plan_.ray_range;
  if (plan_.mechanisms.fringe) count_thin_plate_edges();
  return std::move(result_);
}

void RowCollector::count_thin_plate_edges() {
  const auto [lowest, highest] = std::ranges::minmax(sweep_.frequencies);
  result_.statistics.thin_plate_edges_lowest = count_thin(plan_.target.thin_plate_edges, lowest);
  result_.statistics.thin_plate_edges_highest = count_thin(plan_.target.thin_plate_edges, highest);
}

}  // namespace raytube
