#include "jobs/joined_results.h"

#include <algorithm>
#include <iterator>

#include "solve/rows.h"

namespace raytube {

namespace {

template <class Row>
void append(const std::vector<Row>& rows, std::vector<Row>& all) {
  all.insert(all.end(), rows.begin(), rows.end());
}

// Rows of a column that some parts do not have: zero there.
template <class Row>
void append_column(const std::vector<Row>& rows, std::size_t before, std::vector<Row>& all) {
  if (rows.empty()) return;
  all.resize(before);
  append(rows, all);
}

// The entry of that name, or a new one.
template <class Entry, class Key>
Entry& entry_of(std::vector<Entry>& entries, const Entry& like, Key key) {
  const auto found = std::ranges::find(entries, like.*key, key);
  if (found != entries.end()) return *found;
  entries.emplace_back().*key = like.*key;
  return entries.back();
}

// Sums of squares stand in the place of root mean squares until all parts are there.
void append_model(const std::vector<ModelPart>& parts, std::size_t rows, std::size_t before, std::vector<ModelPart>& all) {
  for (const ModelPart& part : parts) {
    ModelPart& whole = entry_of(all, part, &ModelPart::name);
    whole.what = part.what, whole.remedy = part.remedy;
    whole.rms += part.rms * part.rms * static_cast<double>(rows);
    whole.rows_largest += part.rows_largest;
    append_column(part.rows, before, whole.rows);
  }
}

// Reasons that differ in their figures alone are one, with the largest of these.
void add_skipped(const std::vector<Skipped>& some, std::vector<Skipped>& all) {
  for (const Skipped& each : some) {
    const auto like = [&](const Skipped& other) { return other.what == each.what && other.why == each.why; };
    const auto found = std::ranges::find_if(all, like);
    if (found == all.end()) {
      all.push_back(each);
      continue;
    }
    found->figure = std::max(found->figure, each.figure);
    found->count += each.count;
  }
}

void add_use(const MechanismUse& use, std::vector<MechanismUse>& all) {
  MechanismUse& whole = entry_of(all, use, &MechanismUse::name);
  whole.label = use.label, whole.key = use.key;
  whole.on |= use.on;
  if (!use.on) whole.why_not = use.why_not;
  whole.looks += use.looks, whole.looks_without += use.looks_without;
  whole.most_db = std::max(whole.most_db, use.most_db);
}

void add_beyond(const BeyondBound& beyond, std::size_t before, std::vector<BeyondBound>& all) {
  BeyondBound& whole = entry_of(all, beyond, &BeyondBound::part);
  whole.rows += beyond.rows;
  if (beyond.ratio <= whole.ratio) return;
  whole.ratio = beyond.ratio;
  whole.worst = beyond.worst + before;
}

void add_statistics(const Statistics& part, std::size_t first_look, std::size_t before, Statistics& all) {
  all.tubes += part.tubes, all.rays += part.rays;
  all.hits.resize(std::max(all.hits.size(), part.hits.size()));
  for (std::size_t i = 0; i < part.hits.size(); ++i) all.hits[i] += part.hits[i];
  all.lost_rays += part.lost_rays, all.looks_with_lost_rays += part.looks_with_lost_rays;
  for (LostRay ray : part.first_lost_rays) {
    ray.look += first_look;
    if (all.first_lost_rays.size() < most_lost_rays_told) all.first_lost_rays.push_back(ray);
  }
  add_look(all.truncated, part.truncated);
  all.sliver_area += part.sliver_area;
  all.wedges = std::max(all.wedges, part.wedges);
  all.thin_plate_edges_lowest = std::max(all.thin_plate_edges_lowest, part.thin_plate_edges_lowest);
  all.thin_plate_edges_highest = std::max(all.thin_plate_edges_highest, part.thin_plate_edges_highest);
  for (const Count& count : part.counts) put(count, all.counts);
  all.paths |= part.paths;
  all.ray_range = std::max(all.ray_range, part.ray_range);
  add_skipped(part.skipped, all.skipped);
  for (const MechanismUse& use : part.mechanisms) add_use(use, all.mechanisms);
  for (const BeyondBound& beyond : part.beyond_bound) add_beyond(beyond, before, all.beyond_bound);
}

}  // namespace

SweepResult joined_results(std::vector<SweepResult> parts, std::size_t looks) {
  SweepResult all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const SweepResult part = std::move(parts[i]);
    const std::size_t before = all.total.size(), rows = part.total.size();
    append(part.total, all.total), append(part.error, all.error), append(part.model, all.model);
    append_model(part.model_parts, rows, before, all.model_parts);
    if (all.bounces.size() < part.bounces.size()) all.bounces.resize(part.bounces.size());
    for (std::size_t b = 0; b < part.bounces.size(); ++b) append_column(part.bounces[b], before, all.bounces[b]);
    for (const MechanismRows& mechanism : part.mechanisms)
      append_column(mechanism.rows, before, entry_of(all.mechanisms, mechanism, &MechanismRows::name).rows);
    append_column(part.incoherent, before, all.incoherent);
    add_statistics(part.statistics, i * looks, before, all.statistics);
  }
  const std::size_t rows = all.total.size();
  for (std::vector<ScatteringMatrix>& column : all.bounces) column.resize(rows);
  for (MechanismRows& mechanism : all.mechanisms) mechanism.rows.resize(rows);
  if (!all.incoherent.empty()) all.incoherent.resize(rows);
  std::vector<double> squares;
  for (ModelPart& part : all.model_parts) {
    squares.push_back(part.rms);
    if (!part.rows.empty()) part.rows.resize(rows);
  }
  tell_shares(squares, rows, all.model_parts);
  return all;
}

}  // namespace raytube
