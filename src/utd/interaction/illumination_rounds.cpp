#include "utd/interaction/illumination_rounds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/threads.h"
#include "core/work.h"

namespace raytube {

namespace {

// Sums waiting to be added up in order take so many matrices at most [a megabyte], or those of so many groups.
constexpr std::size_t most_waiting = 16384, least_waiting = 16;
constexpr double points_of_pair = 40.0, faces_of_fan = 20.0;  // as a first guess
constexpr int most_rounds = 24;

// Of one job: the faces that count, and where about the edge they lie. Empty: all.
struct Group {
  const IlluminationJob* job;
  std::vector<std::uint32_t> patches;
  std::vector<AzimuthRange> azimuths;
  LeftOut bounds;  // of its pairs
  double work;     // that it may take
};

double largest(const ScatteringMatrix& s) {
  double most = 0.0;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) most = std::max(most, std::abs(s.at(p, q)));
  return most;
}

class Summer {
 public:
  Summer(const IlluminationLook& look, double tolerance) : look_(look), tolerance_(tolerance) {
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

  const IlluminationSum& sum() const { return sum_; }
  IlluminationSum take() { return std::move(sum_); }
  void leave_out(const EdgeFacePair& pair) { sum_.beyond.add(pair); }

 private:
  IlluminatedFaces of_group(const Group& group) const {
    ReceivingFaces faces{look_.faces.tree, look_.faces.large, look_.faces.corners, group.patches};
    return illuminated_faces(faces, look_.look, look_.wavenumbers, *group.job->piece,
                             {group.job->reflections, tolerance_, group.azimuths, group.work});
  }

  void add(const Group& group, const IlluminatedFaces& part) {
    sum_.work += part.work;
    if (!part.complete) {
      sum_.beyond.count += group.bounds.count;
      sum_.beyond.squares += group.bounds.squares;
      return;
    }
    sum_.bound_squares += group.bounds.squares;
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

// Pairs of the same job are one group; none takes more than twice its share of `work`.
std::vector<Group> groups_of(std::span<const IlluminationJob> jobs, std::span<const EdgeFacePair> pairs, double work) {
  std::vector<EdgeFacePair> sorted(pairs.begin(), pairs.end());
  std::ranges::sort(sorted, {}, [](const EdgeFacePair& pair) { return std::pair(pair.job, pair.patch); });
  std::vector<Group> groups;
  for (const EdgeFacePair& pair : sorted) {
    if (groups.empty() || groups.back().job != &jobs[pair.job]) groups.push_back({&jobs[pair.job], {}, {}, {}, 0.0});
    groups.back().patches.push_back(pair.patch);
    groups.back().azimuths.push_back(pair.bound.azimuths);
    groups.back().bounds.add(pair);
  }
  for (Group& group : groups)
    group.work = std::min(work, 2 * work * static_cast<double>(group.bounds.count) / static_cast<double>(pairs.size()));
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
  for (const IlluminationJob& job : jobs) groups.push_back({&job, {}, {}, {}, std::numeric_limits<double>::infinity()});
  Summer summer(look, tolerance);
  summer.add(groups);
  return summer.take();
}

IlluminationSum illuminate_strongest(const IlluminationLook& look, std::span<const IlluminationJob> jobs,
                                     std::span<const EdgeFacePair> pairs, double tolerance, double work) {
  Summer summer(look, tolerance);
  const auto frequencies = static_cast<double>(look.wavenumbers.size());
  double each = points_of_pair * (work::fan + faces_of_fan * work::face_in_fan + work::ray_row * frequencies);
  std::size_t done = 0;
  for (int round = 0; round < most_rounds && done < pairs.size(); ++round) {
    const double left = work - summer.sum().work, fit = left / 2 / each;
    if (!(left > each)) break;
    const auto count = static_cast<std::size_t>(std::clamp(fit, 1.0, static_cast<double>(pairs.size() - done)));
    summer.add(groups_of(jobs, pairs.subspan(done, count), left));
    done += count;
    each = summer.sum().work / static_cast<double>(done);
  }
  for (const EdgeFacePair& pair : pairs.subspan(done)) summer.leave_out(pair);
  return summer.take();
}

}  // namespace raytube
