#include "utd/interaction/illumination_rounds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/threads.h"
#include "utd/interaction/pair_reach.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// Sums waiting to be added up in order take so many matrices at most [a megabyte], or those of so many groups.
constexpr std::size_t most_waiting = 16384, least_waiting = 16;

// Of one job: the faces that count, and where about the edge they lie. Empty: all.
struct Group {
  const IlluminationJob* job;
  std::size_t index;  // of the job
  std::vector<std::uint32_t> patches;
  std::vector<AzimuthRange> azimuths;
  LeftOut bounds;  // of its pairs
};

double largest(const ScatteringMatrix& s) {
  double most = 0.0;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) most = std::max(most, std::abs(s.at(p, q)));
  return most;
}

class Summer {
 public:
  Summer(const IlluminationLook& look, std::size_t jobs, double tolerance) : look_(look), tolerance_(tolerance) {
    for (auto& row : sum_.error) row.fill(look.least_error);
    if (look.jobs_at) sum_.of_jobs.resize(jobs);
    sum_.scattering.resize(look.wavenumbers.size());
    sum_.squares.resize(look.wavenumbers.size());
  }

  // Side by side, a few at a time; added up in order.
  void add(std::span<const Group> groups) {
    const std::size_t at_a_time = std::max(least_waiting, most_waiting / look_.wavenumbers.size());
    for (std::size_t first = 0; first < groups.size(); first += at_a_time) {
      const std::span<const Group> here = groups.subspan(first, std::min(at_a_time, groups.size() - first));
      parts_.resize(here.size());
      tbb::parallel_for(std::size_t{0}, here.size(), [&](std::size_t i) { parts_[i] = of_group(here[i]); });
      stop_if_cancelled();
      for (std::size_t i = 0; i < here.size(); ++i) add(here[i], parts_[i]);
    }
  }

  IlluminationSum take() { return std::move(sum_); }
  void leave_out(const EdgeFacePair& pair) { sum_.beyond.add(pair); }

 private:
  IlluminatedFaces of_group(const Group& group) const {
    ReceivingFaces faces{look_.faces.tree, look_.faces.large, look_.faces.corners, group.patches, {}, {}, look_.faces.materials};
    return illuminated_faces(
        faces, look_.look, look_.wavenumbers, *group.job->piece,
        {group.job->reflections, tolerance_, group.azimuths, look_.places.empty() ? nullptr : &look_.places[group.index]});
  }

  void add(const Group& group, const IlluminatedFaces& part) {
    sum_.work += part.work;
    sum_.pairs += group.bounds.count;
    sum_.bound_squares += group.bounds.squares;
    std::ranges::copy(part.pieces, std::back_inserter(sum_.pieces));
    if (look_.jobs_at) sum_.of_jobs[group.index] += part.scattering[*look_.jobs_at];
    for (std::size_t f = 0; f < sum_.scattering.size(); ++f) {
      const double size = largest(part.scattering[f]);
      sum_.scattering[f] += part.scattering[f];
      sum_.squares[f] += size * size;
    }
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) sum_.error[p][q] += part.error[p][q];
  }

  const IlluminationLook& look_;
  double tolerance_;
  std::vector<IlluminatedFaces> parts_;
  IlluminationSum sum_;
};

// Pairs of the same job are one group.
std::vector<Group> groups_of(std::span<const IlluminationJob> jobs, std::span<const EdgeFacePair> pairs) {
  std::vector<EdgeFacePair> sorted(pairs.begin(), pairs.end());
  std::ranges::sort(sorted, {}, [](const EdgeFacePair& pair) { return std::pair(pair.job, pair.patch); });
  std::vector<Group> groups;
  for (const EdgeFacePair& pair : sorted) {
    if (groups.empty() || groups.back().job != &jobs[pair.job]) groups.push_back({&jobs[pair.job], pair.job, {}, {}, {}});
    groups.back().patches.push_back(pair.patch);
    groups.back().azimuths.push_back(pair.bound.azimuths);
    groups.back().bounds.add(pair);
  }
  return groups;
}

constexpr double points_at_a_time = 50.0;  // of the longest Gauss rule, and sums

}  // namespace

double illumination_bytes(std::size_t frequencies, double pairs) {
  const auto all = static_cast<double>(frequencies);
  const double waiting = std::max(all * least_waiting, static_cast<double>(most_waiting));
  const double kept = std::min(2.0 * most_pairs_kept, pairs);
  return (waiting + all * points_at_a_time) * sizeof(ScatteringMatrix) + kept * (2 * sizeof(EdgeFacePair) + sizeof(Group));
}

IlluminationSum illuminate_all(const IlluminationLook& look, std::span<const IlluminationJob> jobs, double tolerance) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < jobs.size(); ++i) groups.push_back({&jobs[i], i, {}, {}, {}});
  Summer summer(look, jobs.size(), tolerance);
  summer.add(groups);
  return summer.take();
}

IlluminationSum illuminate_strongest(const IlluminationLook& look, std::span<const IlluminationJob> jobs,
                                     std::span<const EdgeFacePair> pairs, const PairBudget& budget) {
  Summer summer(look, jobs.size(), budget.tolerance);
  std::vector<double> expected;
  for (const EdgeFacePair& pair : pairs) expected.push_back(pair.bound.expected);
  const std::size_t count = with_equals(expected, budget.pairs, false);
  summer.add(groups_of(jobs, pairs.first(count)));
  for (const EdgeFacePair& pair : pairs.subspan(count)) summer.leave_out(pair);
  return summer.take();
}

}  // namespace raytube
