#include "ranks/ranks.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "core/error.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* plugin_name = "raytube_mpi.so";

int number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  int number = 0;
  if (text) std::from_chars(text, text + std::strlen(text), number);
  return number;
}

bool is_set(const char* variable) { return std::getenv(variable) != nullptr; }

// How many processes were started as one job, and by whom they find each other. Of Open MPI's mpirun, of MPICH's, of Slurm's
// srun.
struct Launch {
  int processes = 1;
  bool connected = true;
};

// RAYTUBE_MPI=off: a process of a job that is to be one alone, as where each has a case of its own.
Launch launch_of_this() {
  if (const char* const wish = std::getenv("RAYTUBE_MPI"); wish && std::string_view(wish) == "off") return {};
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (is_set(variable)) return {number_in(variable), true};
  if (const int tasks = number_in("SLURM_STEP_NUM_TASKS"); tasks > 1 && is_set("SLURM_PROCID"))
    return {tasks, is_set("PMIX_RANK")};
  return {};
}

void* plugin(const std::vector<fs::path>& folders) {
  std::error_code ignored;
  for (const fs::path& folder : folders)
    if (const fs::path file = folder / plugin_name; fs::exists(file, ignored)) {
      // MPI loads plugins of its own, which look for it among what is there for all.
      if (void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL)) return library;
      throw InputError(
          fmt::format("MPI cannot be loaded ({}); install it as it was when this raytube was built, or do "
                      "without it",
                      dlerror()));
    }
  return nullptr;
}

template <class Function>
Function* function_of(void* library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

std::unique_ptr<Ranks> started(Ranks* ranks) {
  if (!ranks) throw InputError("this MPI cannot be used by programs with threads (MPI_THREAD_SERIALIZED); use another one");
  return std::unique_ptr<Ranks>(ranks);
}

}  // namespace

std::unique_ptr<Ranks> launched_ranks(const std::vector<fs::path>& folders) {
  const Launch launch = launch_of_this();
  if (launch.processes <= 1) return {};
  if (!launch.connected)
    throw InputError(
        fmt::format("srun has started {} processes that cannot find each other; start them by srun --mpi=pmix, by "
                    "mpirun, or one alone",
                    launch.processes));
  void* const library = plugin(folders);
  if (!library)
    throw InputError(
        fmt::format("was started as {} processes, and has no MPI ({} is not there); start one alone, or build with "
                    "-DRAYTUBE_MPI=ON",
                    launch.processes, plugin_name));
  std::unique_ptr<Ranks> ranks = started(function_of<Ranks*()>(library, "raytube_ranks_of_launch")());
  if (ranks->count() == launch.processes) return ranks;
  throw InputError(fmt::format(
      "was started as {} processes, of which its MPI finds {}; start it by the mpirun of the MPI that this raytube was "
      "built with",
      launch.processes, ranks->count()));
}

std::unique_ptr<Ranks> ranks_of_communicator(int fortran_handle, const std::vector<fs::path>& folders) {
  void* const library = plugin(folders);
  if (!library)
    throw InputError(fmt::format("comm: this raytube has no MPI ({} is not there); build it with -DRAYTUBE_MPI=ON", plugin_name));
  return started(function_of<Ranks*(int)>(library, "raytube_ranks_of_communicator")(fortran_handle));
}

bool is_first_process() {
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", "SLURM_PROCID"})
    if (is_set(variable)) return number_in(variable) == 0;
  return true;
}

}  // namespace raytube
