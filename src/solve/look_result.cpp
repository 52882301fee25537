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

}  // namespace

void put_band(const BandPlan& band, LookResult part, std::size_t frequencies, LookResult& all) {
  const auto scatter = [&]<class Value>(std::vector<Value>& values, std::vector<Value>& among_all) {
    if (values.empty()) return;
    among_all.resize(frequencies);
    for (std::size_t i = 0; i < values.size(); ++i) among_all[band.indices[i]] = values[i];
    values.clear();
  };
  for (std::size_t b = 0; b < part.tubes.bounces.size(); ++b) {
    scatter(part.tubes.bounces[b], all.tubes.at(static_cast<int>(b), frequencies));
    all.tubes.hits[b] += part.tubes.hits[b];
  }
  scatter(part.tubes.incoherent, all.tubes.incoherent);
  scatter(part.tubes.inside, all.tubes.inside);
  scatter(part.tubes.error, all.tubes.error);
  part.tubes.bounces.clear(), part.tubes.coarse.clear(), part.tubes.pieces.clear(), part.tubes.quadrature.clear();
  add_look(all.tubes.truncated, std::exchange(part.tubes.truncated, {}));
  all.tubes.add(part.tubes);  // its counts, which are those of another trace
  std::ranges::move(part.met, std::back_inserter(all.met));
  std::ranges::copy(part.truncated, std::back_inserter(all.truncated));
  all.mechanisms.resize(part.mechanisms.size());
  for (std::size_t i = 0; i < part.mechanisms.size(); ++i) {
    Contribution &from = part.mechanisms[i], &to = all.mechanisms[i];
    if (to.s.size() < from.s.size()) to.s.resize(from.s.size());
    for (std::size_t column = 0; column < from.s.size(); ++column) scatter(from.s[column], to.s[column]);
    scatter(from.error, to.error), scatter(from.missing, to.missing), scatter(from.ran, to.ran);
    to.most_db = std::max(to.most_db, from.most_db);
    to.work += from.work;
    to.reach = std::min(to.reach, from.reach);
    for (Count& count : from.counts) put(std::move(count), to.counts);
  }
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
