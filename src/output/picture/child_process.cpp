#include "output/picture/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>

namespace raytube {

namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (std::string& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& arguments, ChildOutput output,
                   const std::vector<std::pair<std::string, std::string>>& environment) {
  std::vector<std::string> words = arguments, settings;
  for (const auto& [name, value] : environment) settings.push_back(name + '=' + value);
  for (char** setting = environ; *setting; ++setting) settings.emplace_back(*setting);  // of equal names the first one counts
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (output == ChildOutput::silent)
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, words.front().c_str(), &actions, nullptr, pointers(words).data(), pointers(settings).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return {true, -1};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) kill(child, SIGTERM);  // whoever stops raytube means the child, too
  return {false, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

}  // namespace raytube
