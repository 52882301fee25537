// Items of a solve: computed here, found by another process, or kept from before.
#pragma once

#include <tbb/parallel_for.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/threads.h"
#include "core/work_sharing.h"
#include "scene/options.h"
#include "solve/shard.h"

namespace raytube {

/// Looks of a plan, or whatever else can be computed each by itself and told as bytes.
template <class Item>
struct SharedItems {
  std::size_t count;                                                              // how many there are
  int threads;                                                                    // for all of them; 0: all cores
  std::function<Item(std::size_t index, Progress& progress, double share)> find;  // computes one
  std::string (*bytes)(const Item& item);                                         // of it
  std::function<std::optional<Item>(const std::string& bytes)> of_bytes;  // the same again; none: these are of something else
};

/// Takes the items kept from an earlier solve first, so that the progress shows the rate of the new ones; then computes those of
/// the shard that the team hands to this process. Each new one is handed to kept.keep, every one to `done` where there is one, in
/// any order. Items run side by side, tasks within one too; every sum is taken in index order, so threads never show in the
/// result.
template <class Item>
void compute_shared(const SharedItems<Item>& items, const Shard& shard, const std::function<bool(double)>& callback,
                    const KeptLooks& kept, WorkTeam* team, const std::function<void(std::size_t, const Item&)>& done) {
  TeamOfOne alone;
  WorkTeam& all = team ? *team : alone;
  Progress progress(callback);
  const double share = all.leads() ? 1.0 / static_cast<double>(shard.size(items.count)) : 0.0;
  const auto take_kept = [&] {
    std::vector<char> known(items.count);
    tbb::parallel_for(std::size_t{0}, known.size(), [&](std::size_t index) {
      const std::string bytes = kept.find ? kept.find(index) : "";
      const std::optional<Item> item = bytes.empty() ? std::nullopt : items.of_bytes(bytes);
      if (!item) return;
      if (done) done(index, *item);
      known[index] = 1;
      progress.add(share);
    });
    progress.add(0.0);
    return std::vector<bool>(known.begin(), known.end());
  };
  run_on_threads(items.threads, [&] {
    std::vector<bool> known = all.leads() ? take_kept() : std::vector<bool>(items.count);
    for (std::size_t index = 0; index < items.count; ++index) known[index] = known[index] || !shard.has(index);
    TeamMember member(all, known, [&](std::size_t index, std::string bytes) {
      if (done) done(index, items.of_bytes(bytes).value());
      if (kept.keep) kept.keep(index, std::move(bytes));
      progress.add(share);
    });
    compute_items(all, items.count, items.threads, [&](std::size_t index) {
      const Item found = items.find(index, progress, share);
      if (done) done(index, found);
      if (kept.keep) kept.keep(index, items.bytes(found));
    });
    member.finish();
  });
}

/// The items of a shard into the hands of `kept` alone.
template <class Item>
void compute_shard(const SharedItems<Item>& items, const Shard& shard, const std::function<bool(double)>& callback,
                   const KeptLooks& kept, WorkTeam* team) {
  const std::size_t own = shard.size(items.count);
  if (kept.begin) kept.begin(own);
  if (own > 0 || team) compute_shared<Item>(items, shard, callback, kept, team, {});
}

/// Items for the process that leads the team.
template <class Item>
void compute_for_leader(const SharedItems<Item>& items, WorkTeam& team, const std::function<bool(double)>& callback) {
  const KeptLooks given{
      .begin = {}, .find = {}, .keep = [&team](std::size_t index, std::string bytes) { team.give(index, std::move(bytes)); }};
  compute_shared<Item>(items, {}, callback, given, &team, {});
}

}  // namespace raytube
