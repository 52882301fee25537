#include "solve/look_result.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/bytes.h"

namespace raytube {

namespace {

// One list of members for both ways.
template <class Archive, class Look>
void visit(Archive& archive, Look& look) {
  auto& [tubes, others, met, truncated] = look;
  archive(tubes.bounces), archive(tubes.incoherent), archive(tubes.inside), archive(tubes.error), archive(tubes.hits);
  archive(tubes.tubes), archive(tubes.rays), archive(tubes.lost_rays), archive(tubes.truncated), archive(tubes.first_lost);
  archive(tubes.empty_cells), archive(tubes.faces_away), archive(tubes.sliver_area);
  archive(met), archive(truncated);
  for (auto& part : others.s.of) archive(part);
  archive(others.error), archive(others.left_out), archive(others.windowed), archive(others.skipped);
  for (auto& run : others.runs) archive(run.ran), archive(run.most_db), archive(run.work), archive(run.reach);
  archive(others.wedges_lit), archive(others.surface_strips), archive(others.illuminating_pieces);
  archive(others.interaction_pairs), archive(others.edges_lit);
}

bool has_frequencies(const LookResult& look, std::size_t count) {
  const auto none_or_all = [count](const auto& list) { return list.empty() || list.size() == count; };
  const auto all = [count](const auto& list) { return list.size() == count; };
  const auto ran_none_or_all = [&](const MechanismRun& run) { return none_or_all(run.ran); };
  return std::ranges::all_of(look.tubes.bounces, all) && all(look.tubes.error) && none_or_all(look.tubes.incoherent) &&
         none_or_all(look.tubes.inside) && std::ranges::all_of(look.others.s.of, none_or_all) && none_or_all(look.others.error) &&
         none_or_all(look.others.left_out) && none_or_all(look.others.windowed) &&
         std::ranges::all_of(look.others.runs, ran_none_or_all);
}

// Puts values of a band where they belong among all.
class BandScatter {
 public:
  BandScatter(const BandPlan& band, std::size_t frequencies) : band_(band), frequencies_(frequencies) {}

  template <class Value>
  void operator()(std::vector<Value>&& part, std::vector<Value>& all) const {
    if (part.empty()) return;
    all.resize(frequencies_);
    for (std::size_t i = 0; i < part.size(); ++i) all[band_.indices[i]] = part[i];
  }

 private:
  const BandPlan& band_;
  std::size_t frequencies_;
};

// Its counts are those of another trace.
void put_tubes(const BandScatter& scatter, TubeSums part, std::size_t frequencies, TubeSums& all) {
  for (std::size_t b = 0; b < part.bounces.size(); ++b)
    scatter(std::move(part.bounces[b]), all.at(static_cast<int>(b), frequencies)), all.hits[b] += part.hits[b];
  scatter(std::move(part.incoherent), all.incoherent);
  scatter(std::move(part.inside), all.inside);
  scatter(std::move(part.error), all.error);
  part.bounces.clear(), part.incoherent.clear(), part.inside.clear(), part.error.clear();
  part.coarse.clear(), part.pieces.clear(), part.quadrature.clear();
  add_look(all.truncated, std::exchange(part.truncated, {}));
  all.add(part);
}

void put_runs(const BandScatter& scatter, LookSums& part, LookSums& all) {
  for (std::size_t i = 0; i < mechanism_count; ++i) {
    scatter(std::move(part.runs[i].ran), all.runs[i].ran);
    all.runs[i].most_db = std::max(all.runs[i].most_db, part.runs[i].most_db);
    all.runs[i].work += part.runs[i].work;
    all.runs[i].reach = std::min(all.runs[i].reach, part.runs[i].reach);
  }
}

}  // namespace

void put_band(const BandPlan& band, LookResult part, std::size_t frequencies, LookResult& all) {
  const BandScatter scatter(band, frequencies);
  put_tubes(scatter, std::move(part.tubes), frequencies, all.tubes);
  std::ranges::move(part.met, std::back_inserter(all.met));
  std::ranges::copy(part.truncated, std::back_inserter(all.truncated));
  LookSums &others = part.others, &sums = all.others;
  for (std::size_t i = 0; i < all_parts.size(); ++i) scatter(std::move(others.s.of[i]), sums.s.of[i]);
  scatter(std::move(others.error), sums.error);
  scatter(std::move(others.left_out), sums.left_out);
  scatter(std::move(others.windowed), sums.windowed);
  put_runs(scatter, others, sums);
  sums.skipped += others.skipped;
  sums.wedges_lit = std::max(sums.wedges_lit, others.wedges_lit);
  sums.surface_strips += others.surface_strips;
  sums.illuminating_pieces += others.illuminating_pieces;
  sums.interaction_pairs += others.interaction_pairs;
  sums.edges_lit = sums.edges_lit || others.edges_lit;
}

void LookResult::keep_sums_only() {
  tubes.coarse = {};
  tubes.pieces = {};
  tubes.quadrature = {};
}

std::string look_bytes(const LookResult& look) {
  const std::size_t matrices = (look.tubes.bounces.size() + 5) * look.tubes.error.size();
  ByteWriter writer(matrices * sizeof(ScatteringMatrix) + 1000);
  visit(writer, look);
  return writer.take();
}

std::optional<LookResult> look_of_bytes(std::string_view bytes, std::size_t frequencies) {
  LookResult look;
  ByteReader reader(bytes);
  visit(reader, look);
  if (!reader.fits() || !has_frequencies(look, frequencies)) return {};
  return look;
}

}  // namespace raytube
