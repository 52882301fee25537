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
  auto& [tubes, mechanisms, met, truncated] = look;
  archive(tubes.bounces), archive(tubes.incoherent), archive(tubes.inside), archive(tubes.error), archive(tubes.hits);
  archive(tubes.tubes), archive(tubes.rays), archive(tubes.lost_rays), archive(tubes.truncated), archive(tubes.first_lost);
  archive(tubes.empty_cells), archive(tubes.faces_away), archive(tubes.sliver_area);
  archive(met), archive(truncated), archive(mechanisms);
}

bool has_frequencies(const LookResult& look, std::size_t count) {
  const auto all = [count](const auto& list) { return list.size() == count; };
  const auto none_or_all = [&](const auto& list) { return list.empty() || all(list); };
  const auto fits = [&](const Contribution& part) {
    return std::ranges::all_of(part.s, none_or_all) && none_or_all(part.error) && none_or_all(part.missing) &&
           none_or_all(part.ran);
  };
  return std::ranges::all_of(look.tubes.bounces, all) && all(look.tubes.error) && none_or_all(look.tubes.incoherent) &&
         none_or_all(look.tubes.inside) && std::ranges::all_of(look.mechanisms, fits);
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

void put_contribution(const BandScatter& scatter, Contribution part, Contribution& all) {
  if (all.s.size() < part.s.size()) all.s.resize(part.s.size());
  for (std::size_t column = 0; column < part.s.size(); ++column) scatter(std::move(part.s[column]), all.s[column]);
  scatter(std::move(part.error), all.error);
  scatter(std::move(part.missing), all.missing);
  scatter(std::move(part.ran), all.ran);
  all.most_db = std::max(all.most_db, part.most_db);
  all.work += part.work;
  all.reach = std::min(all.reach, part.reach);
  for (Count& count : part.counts) put(std::move(count), all.counts);
}

}  // namespace

void put_band(const BandPlan& band, LookResult part, std::size_t frequencies, LookResult& all) {
  const BandScatter scatter(band, frequencies);
  put_tubes(scatter, std::move(part.tubes), frequencies, all.tubes);
  std::ranges::move(part.met, std::back_inserter(all.met));
  std::ranges::copy(part.truncated, std::back_inserter(all.truncated));
  all.mechanisms.resize(part.mechanisms.size());
  for (std::size_t i = 0; i < part.mechanisms.size(); ++i)
    put_contribution(scatter, std::move(part.mechanisms[i]), all.mechanisms[i]);
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

std::optional<LookResult> look_of_bytes(std::string_view bytes, std::size_t frequencies, std::size_t mechanisms) {
  LookResult look;
  ByteReader reader(bytes);
  visit(reader, look);
  if (!reader.fits() || look.mechanisms.size() != mechanisms || !has_frequencies(look, frequencies)) return {};
  return look;
}

}  // namespace raytube
