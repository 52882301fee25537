#include "utd/interaction/pair_choice.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>

#include "utd/interaction/pair_reach.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

constexpr std::size_t least_patches = 8;  // beside every piece that is looked at

bool stronger(const EdgeFacePair& a, const EdgeFacePair& b) {
  return std::tuple(-a.bound.expected, a.job, a.patch) < std::tuple(-b.bound.expected, b.job, b.patch);
}

double length_of(const IlluminationJob& job) { return job.piece->weight * (job.piece->to - job.piece->from); }

double sum_of_squares(const auto& values, auto value_of) {
  return std::accumulate(values.begin(), values.end(), 0.0, [&](double sum, const auto& value) {
    const double each = value_of(value);
    return sum + each * each;
  });
}

// Keeps the strongest.
class PairList {
 public:
  void add(const EdgeFacePair& pair) {
    pairs_.push_back(pair);
    if (pairs_.size() >= room_) shorten();
  }
  void finish(PairChoice& choice) {
    shorten();
    std::ranges::sort(pairs_, stronger);
    choice.strongest = std::move(pairs_);
    choice.beyond = dropped_;
  }

 private:
  void shorten() {
    if (pairs_.size() <= most_pairs_kept) return;
    std::ranges::nth_element(pairs_, pairs_.begin() + most_pairs_kept, stronger);
    const double least = pairs_[most_pairs_kept].bound.expected * (1.0 - equally_strong);
    const auto is_strong = [&](const EdgeFacePair& pair) { return pair.bound.expected >= least; };
    const auto weaker = std::partition(pairs_.begin() + most_pairs_kept, pairs_.end(), is_strong);
    std::for_each(weaker, pairs_.end(), [&](const EdgeFacePair& pair) { dropped_.add(pair); });
    pairs_.erase(weaker, pairs_.end());
    room_ = 2 * pairs_.size();
  }

  std::vector<EdgeFacePair> pairs_;
  std::size_t room_ = 2 * most_pairs_kept;
  LeftOut dropped_;
};

// The longest of the jobs, in their order.
std::vector<std::uint32_t> longest(std::span<const IlluminationJob> jobs, double count) {
  std::vector<std::uint32_t> indices(jobs.size());
  std::iota(indices.begin(), indices.end(), 0u);
  std::vector<double> lengths;
  for (const IlluminationJob& job : jobs) lengths.push_back(length_of(job));
  std::ranges::sort(indices, [&](std::uint32_t a, std::uint32_t b) { return lengths[a] > lengths[b]; });
  std::ranges::sort(lengths, std::ranges::greater{});
  indices.resize(with_equals(lengths, count));
  std::ranges::sort(indices);
  return indices;
}

// The weakest pairs, as long as all of them together stay under the tolerance: of equally strong ones all or none.
void drop_weak(PairChoice& choice, double tolerance) {
  std::vector<EdgeFacePair>& pairs = choice.strongest;
  for (double sum = 0.0; !pairs.empty();) {
    auto first = pairs.end();
    const double most = pairs.back().bound.expected * (1.0 + equally_strong);
    while (first != pairs.begin() && (first - 1)->bound.expected <= most) sum += (--first)->bound.amplitude;
    if (sum > tolerance) return;
    std::for_each(first, pairs.end(), [&](const EdgeFacePair& pair) { choice.weak.add(pair); });
    pairs.erase(first, pairs.end());
  }
}

}  // namespace

PairChoice choose_pairs(std::span<const IlluminationJob> jobs, const TriangleMesh& mesh, std::span<const PatchExtent> extents,
                        std::span<const std::uint32_t> patches, const PairLimits& limits) {
  PairChoice choice;
  const double affordable = std::min(limits.work / work::pair_bound, 1e12);
  const double per_job = std::max<double>(least_patches, affordable / static_cast<double>(jobs.size()));
  std::vector<double> areas;
  for (const std::uint32_t patch : patches) areas.push_back(extents[patch].area);
  const std::span near = patches.first(with_equals(areas, per_job));
  const std::vector<std::uint32_t> looked_at = longest(jobs, affordable / static_cast<double>(near.size()));
  PairList list;
  double squares = 0.0;
  for (const std::uint32_t job : looked_at) {
    const LitEdgePiece& piece = *jobs[job].piece;
    const std::array<WedgeFace, 2>& own = piece.edge->wedge->faces;
    for (const std::uint32_t patch : near) {
      if (patch == own[0].patch || patch == own[1].patch) continue;
      const PairBound bound = pair_bound(piece, mesh.patches[patch], extents[patch], limits.view, jobs[job].reflections);
      if (bound.amplitude == 0.0) continue;
      squares += bound.expected * bound.expected;
      list.add({job, patch, bound});
    }
  }
  choice.work = work::pair_bound * static_cast<double>(looked_at.size() * near.size());
  list.finish(choice);
  drop_weak(choice, limits.tolerance);
  const auto length = [&](const IlluminationJob& job) { return length_of(job); };
  const auto area = [&](std::uint32_t patch) { return extents[patch].area; };
  const double lengths = sum_of_squares(looked_at, [&](std::uint32_t job) { return length_of(jobs[job]); });
  const double all = sum_of_squares(jobs, length) * sum_of_squares(patches, area);
  const double seen = lengths * sum_of_squares(near, area);
  choice.beyond.count += jobs.size() * patches.size() - looked_at.size() * near.size();
  if (seen > 0.0) choice.beyond.squares += squares * std::max(0.0, all / seen - 1.0);
  return choice;
}

}  // namespace raytube
