#include "solve/rows.h"

#include <algorithm>
#include <numeric>

#include "solve/parts.h"

namespace raytube {

namespace {

ScatteringMatrix scaled(ScatteringMatrix matrix, Complex factor) { return matrix *= factor; }

}  // namespace

RowCollector::RowCollector(const Target& target, const Sweep& sweep, const SolveOptions& options, const LookPlan& plan)
    : target_(target),
      sweep_(sweep),
      options_(options),
      plan_(plan),
      first_(plan.computed.size() + 1),
      following_(sweep.looks.size()),
      sliver_areas_(plan.computed.size()) {
  for (const LookSource& source : plan.sources) ++first_[source.place + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next = first_;
  for (std::size_t i = 0; i < following_.size(); ++i) following_[next[plan.sources[i].place]++] = i;
  result_.total.resize(sweep.rows());
  result_.error.resize(sweep.rows());
  if (any_rough(sweep.materials)) result_.incoherent.resize(sweep.rows());
  if (!options.keep_parts) return;
  result_.edges_first.resize(sweep.rows());
  result_.edges_higher.resize(sweep.rows());
  result_.interaction.resize(sweep.rows());
}

void RowCollector::add(std::size_t place, const LookResult& look) {
  const std::lock_guard lock(mutex_);
  count(place, look);
  for (std::size_t i = first_[place]; i < first_[place + 1]; ++i) add_rows(following_[i], look, plan_.sources[following_[i]]);
}

// What was traced for a look.
void RowCollector::count(std::size_t place, const LookResult& look) {
  Statistics& all = result_.statistics;
  all.tubes += look.tubes.tubes;
  all.rays += look.tubes.rays;
  all.lost_rays += look.tubes.lost_rays;
  all.tubes_truncated += look.tubes.tubes_truncated;
  sliver_areas_[place] = look.tubes.sliver_area;
  if (all.hits.size() < look.tubes.hits.size()) all.hits.resize(look.tubes.hits.size());
  for (std::size_t b = 0; b < look.tubes.hits.size(); ++b) all.hits[b] += look.tubes.hits[b];
  skipped_.empty_cells += look.tubes.empty_cells;
  skipped_.faces_away += look.tubes.faces_away;
}

void RowCollector::add_rows(std::size_t look, const LookResult& part, const LookSource& source) {
  for (std::size_t f = 0; f < sweep_.frequencies.size(); ++f) add_row(look, f, part, source);
  if (!part.tubes.incoherent.empty())
    std::ranges::copy(part.tubes.incoherent, result_.incoherent.begin() + static_cast<std::ptrdiff_t>(sweep_.row(look, 0)));
  Statistics& all = result_.statistics;
  all.wedges_lit += part.edges.wedges_lit;
  all.illuminating_pieces += part.interaction.illuminating_pieces;
  for (const bool windowed : part.edges.windowed) all.windowed_rows += windowed ? 1 : 0;
  if (part.tubes.tubes == 0 && options_.edges.method != EdgeMethod::utd) ++looks_without_tubes_;
  if (options_.edges.method == EdgeMethod::fringe && !part.edges.lit)
    ++(part.edges.scattering.empty() ? skipped_.edgeless_looks : skipped_.unlit_looks);
}

void RowCollector::add_row(std::size_t look, std::size_t f, const LookResult& part, const LookSource& source) {
  const std::size_t row = sweep_.row(look, f);
  const Complex factor = to_mesh_origin(target_.mesh, sweep_.looks[look], sweep_.frequencies[f]);
  result_.error[row] = part.tubes.error[f];
  for (std::size_t b = 0; b < part.tubes.bounces.size(); ++b) {
    const ScatteringMatrix bounce = scaled(from_source(part.tubes.bounces[b][f], source), factor);
    result_.total[row] += bounce;
    if (!options_.keep_parts) continue;
    if (result_.bounces.size() <= b) result_.bounces.emplace_back(sweep_.rows());
    result_.bounces[b][row] = bounce;
  }
  add_interaction(row, f, part, source, factor);
  if (part.edges.scattering.empty()) return;
  add_edges(row, scaled(from_source(part.edges.scattering[f], source), factor), result_.edges_first);
  if (part.edges.higher.empty()) return;
  add_edges(row, scaled(from_source(part.edges.higher[f], source), factor), result_.edges_higher);
}

void RowCollector::add_interaction(std::size_t row, std::size_t f, const LookResult& part, const LookSource& source,
                                   Complex factor) {
  if (part.interaction.scattering.empty()) return;
  add_edges(row, scaled(from_source(part.interaction.scattering[f], source), factor), result_.interaction);
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) result_.error[row][p][q] += part.interaction.error[f][p][q];
}

void RowCollector::add_edges(std::size_t row, const ScatteringMatrix& edges, std::vector<ScatteringMatrix>& part) {
  result_.total[row] += edges;
  if (options_.keep_parts) part[row] = edges;
}

SweepResult RowCollector::finish(const std::vector<bool>& above_limit) {
  Statistics& all = result_.statistics;
  all.sliver_area = std::accumulate(sliver_areas_.begin(), sliver_areas_.end(), 0.0);
  if (looks_without_tubes_) all.skipped.push_back({"tubes of a look", "the target has no projected area", looks_without_tubes_});
  for (const Skipped& left_out : skipped_wedges(target_.wedges, target_.rims, options_.edges, sweep_.frequencies))
    if (left_out.count) all.skipped.push_back(left_out);
  skipped_.repeated_looks = plan_.repeated;
  skipped_.mirrored_looks = plan_.mirrored;
  skipped_.frequencies_above_interaction_limit = static_cast<std::uint64_t>(std::ranges::count(above_limit, true));
  skipped_.near_looks = looks_too_near_for_interaction(target_, sweep_, options_.edges);
  skipped_.material_looks = looks_without_interaction_for_materials(target_, sweep_, options_.edges);
  if (options_.tubes.skip) count_spared_by_shape();
  for (const Skipped& item : skipped_items(skipped_)) all.skipped.push_back(item);
  all.wedges = target_.wedges.size();
  if (options_.edges.method == EdgeMethod::fringe) count_thin_plate_edges();
  return std::move(result_);
}

void RowCollector::count_spared_by_shape() {
  const std::vector<std::uint64_t>& hits = result_.statistics.hits;
  if (target_.convexity.no_reflection && !hits.empty()) skipped_.reflected_tubes = hits[0];
  if (options_.edges.method != EdgeMethod::none) skipped_.enclosed_wedges = target_.wedges_enclosed;
}

void RowCollector::count_thin_plate_edges() {
  const auto [lowest, highest] = std::ranges::minmax(sweep_.frequencies);
  result_.statistics.thin_plate_edges_lowest = thin_rims(target_.rims, lowest);
  result_.statistics.thin_plate_edges_highest = thin_rims(target_.rims, highest);
}

}  // namespace raytube
