// The processes that a launcher of MPI programs has started as one job.
//
// MPI itself is in a plugin of its own (mpi/, raytube_mpi.so), which is loaded where the launcher's variables say that this
// process is one of several: the program runs on machines without MPI, and starts no slower on those with it.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/work_team.h"

namespace raytube {

/// This process among them. Rank 0 leads: it alone reads meshes, writes files and talks to the user.
class Ranks {
 public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  virtual int rank() const = 0;
  virtual int count() const = 0;
  bool leads() const { return rank() == 0; }

  /// Threads for each, so that those of one machine share the processors that the launcher has given them.
  virtual int threads() const = 0;

  /// To be called by all: `bytes` of the leader to every other process.
  virtual void broadcast(std::string& bytes) = 0;

  /// They share work as often as they like, one list of items after the other.
  virtual WorkTeam& team() = 0;

  /// Of one that cannot go on. Of a job that was launched as such: ends all of them with this exit code. The leader has told the
  /// user why; of any other one it tells this sentence. Of a communicator: the others throw it as RankFailed where they wait for
  /// this one; returns when all have. After end(), and on those who have thrown that, it does nothing.
  virtual void fail(int code, const std::string& sentence) = 0;

  /// To be called by all when they share nothing any more, on a communicator also after fail(); again, it does nothing. Throws
  /// what has befallen another one.
  virtual void end() = 0;
};

/// What has befallen another process of the job: a sentence, and the exit code that goes with it.
class RankFailed : public std::runtime_error {
 public:
  RankFailed(int code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  int code() const { return code_; }

 private:
  int code_;
};

/// The job that this process is one of; null: it was started alone. `plugins`: folders in which raytube_mpi.so may be. Throws
/// InputError if there are several and they cannot find each other.
std::unique_ptr<Ranks> launched_ranks(const std::vector<std::filesystem::path>& plugins);

/// The ranks of a communicator, by its Fortran handle, in a program that has started MPI itself. To be called by all of them.
std::unique_ptr<Ranks> ranks_of_communicator(int fortran_handle, const std::vector<std::filesystem::path>& plugins);

/// Of the processes of a launcher, whether they found each other or not: the one that tells the user what is wrong.
bool is_first_process();

}  // namespace raytube
