// The plugin: what ranks/ranks.h asks for, by MPI (4.1.4 of Open MPI was tried; nothing is asked that MPI 3.0 has not).
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include "core/error.h"
#include "mpi/mpi_calls.h"
#include "mpi/mpi_collectives.h"
#include "mpi/mpi_team.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

constexpr std::size_t longest_sentence = 800;                  // no message of this length waits to be received
constexpr auto patience_of_failed = std::chrono::seconds(60);  // with a leader that should end the job

cpu_set_t allowed_processors() {
  cpu_set_t processors;
  CPU_ZERO(&processors);
  sched_getaffinity(0, sizeof processors, &processors);
  return processors;
}

// Those of one machine that may run on the same processors share them.
int threads_of_each(MPI_Comm all) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(all, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  int ranks = 1;
  MPI_Comm_size(machine, &ranks);
  const cpu_set_t own = allowed_processors();
  std::vector<cpu_set_t> of_all(static_cast<std::size_t>(ranks));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, of_all.data(), sizeof own, MPI_BYTE, machine);
  MPI_Comm_free(&machine);
  const auto sharing = std::ranges::count_if(of_all, [&](const cpu_set_t& other) { return CPU_EQUAL(&own, &other); });
  return std::max(1, CPU_COUNT(&own) / static_cast<int>(sharing));
}

class MpiRanks final : public Ranks {
 public:
  /// Of MPI_COMM_WORLD, which it initialises, or of a communicator of somebody who has.
  explicit MpiRanks(MPI_Comm parent, bool owns) : owns_(owns) {
    MPI_Comm_dup(parent, &all_);
    MPI_Comm_set_errhandler(all_, MPI_ERRORS_ARE_FATAL);  // mpi4py has it return codes, which nobody here looks at
    MPI_Comm_rank(all_, &rank_);
    MPI_Comm_size(all_, &count_);
    threads_ = threads_of_each(all_);
    team_.emplace(MPI_Comm_c2f(all_));
  }

  // Without end(), as after an error: nobody waits for the others, and communicators go with the process.
  ~MpiRanks() override = default;

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  int threads() const override { return threads_; }
  void broadcast(std::string& bytes) override {
    team_->meet();
    mpi_broadcast(MPI_Comm_c2f(all_), bytes);
  }
  WorkTeam& team() override { return *team_; }

  void fail(int code, const std::string& sentence) override {
    if (ended_) return;
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    const std::string told = "rank " + std::to_string(rank_) + " on " + host.data() + ": " + sentence.substr(0, longest_sentence);
    if (!owns_) return team_->fail(code, told, [] {});
    if (rank_ != 0) {
      await_leader(code, told);
      std::fprintf(stderr, "raytube: %s\n", told.c_str());
    }
    MPI_Abort(all_, code);
  }

  void end() override {
    if (ended_) return;
    team_->meet();
    ended_ = true;
    team_->free();
    team_.reset();
    MPI_Comm_free(&all_);
    if (owns_) MPI_Finalize();
  }

 private:
  // It ends the job once it has been told; returns if it has not.
  void await_leader(int code, const std::string& told) {
    const auto latest = std::chrono::steady_clock::now() + patience_of_failed;
    struct Late {};
    try {
      team_->fail(code, told, [&] {
        if (std::chrono::steady_clock::now() > latest) throw Late();
      });
      std::this_thread::sleep_until(latest);
    } catch (const Late&) {
    }
  }

  bool owns_, ended_ = false;
  MPI_Comm all_ = MPI_COMM_NULL;
  int rank_ = 0, count_ = 1, threads_ = 1;
  std::optional<MpiTeam> team_;
};

}  // namespace

extern "C" {

/// Starts MPI; the ranks of all that were launched. Null if MPI cannot be used by several threads.
Ranks* raytube_ranks_of_launch() {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
  return provided >= MPI_THREAD_SERIALIZED ? new MpiRanks(MPI_COMM_WORLD, true) : nullptr;
}

/// Those of the communicator with this Fortran handle, in a program that has started MPI. Throws InputError if it has not.
Ranks* raytube_ranks_of_communicator(int communicator) {
  int is_started = 0, provided = 0;
  MPI_Initialized(&is_started);
  if (is_started == 0) throw InputError("comm: mpi4py uses another MPI than this raytube; build one of them with the other's");
  MPI_Query_thread(&provided);
  return provided >= MPI_THREAD_SERIALIZED ? new MpiRanks(MPI_Comm_f2c(communicator), false) : nullptr;
}
}

}  // namespace raytube
