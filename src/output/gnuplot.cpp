#include "output/gnuplot.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace raytube {

namespace {

// No shell in between: nothing in a path needs quoting, and a missing program is seen as such.
int spawn_silently(const char* const* arguments, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, const_cast<char* const*>(arguments), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

std::string run_gnuplot(const std::filesystem::path& script) {
  const std::string name = script.string();
  const std::array<const char*, 4> arguments = {"gnuplot", "-d", name.c_str(), nullptr};  // -d: no user settings
  pid_t child = 0;
  if (spawn_silently(arguments.data(), child) != 0) return "gnuplot is not installed";
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) kill(child, SIGTERM);  // whoever stops us means the plot too
  if (!WIFEXITED(status)) return "gnuplot was stopped";
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("gnuplot failed with status {}", WEXITSTATUS(status));
}

}  // namespace raytube
