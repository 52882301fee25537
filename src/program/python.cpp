#include "program/python.h"

#include <fmt/format.h>

#include <cstdlib>

#include "output/picture/child_process.h"
#include "program/work/exit_codes.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr int no_package = 93;

// Says nothing where the package is missing: the sentence about that comes once, after the last interpreter.
constexpr const char* start =
    "import sys\n"
    "try:\n"
    "    from raytube.__main__ import main\n"
    "except ImportError:\n"
    "    sys.exit(93)\n"
    "sys.exit(main(sys.argv[1:]))\n";

// RAYTUBE_PYTHON, or else the first of these that has the package: beside the program, on the search path, the system's.
std::vector<std::string> interpreters(const fs::path& program) {
  if (const char* const named = std::getenv("RAYTUBE_PYTHON")) return {named};
  std::vector<std::string> all = {"python3", "/usr/bin/python3"};
  if (fs::exists(program / "python3")) all.insert(all.begin(), (program / "python3").string());
  return all;
}

// The package lies beside the program where both were built, and below the prefix where they were installed.
std::vector<std::pair<std::string, std::string>> python_path(const fs::path& program) {
  for (const fs::path& folder : {program / "python", program.parent_path() / "lib/python3/dist-packages"}) {
    if (!fs::exists(folder / "raytube" / "__init__.py")) continue;
    const char* const others = std::getenv("PYTHONPATH");
    return {{"PYTHONPATH", others ? fmt::format("{}:{}", folder.string(), others) : folder.string()}};
  }
  return {};
}

// The exit code; no_package where no interpreter has it.
int python(const std::vector<std::string>& words, ChildOutput output) {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const std::string& interpreter : interpreters(program)) {
    std::vector<std::string> arguments = {interpreter, "-c", start};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const ChildEnd end = run_child(arguments, output, python_path(program));
    if (!end.missing && end.code != no_package) return end.code < 0 ? exit_code::machine_failed : end.code;
  }
  return no_package;
}

}  // namespace

int run_python(const std::vector<std::string>& words) {
  const int code = python(words, ChildOutput::ours);
  if (code != no_package) return code;
  fmt::print(stderr,
             "raytube: {} needs the Python package raytube, which no python3 here has; install the .deb of raytube, or run "
             "pip install . in its source folder\n",
             words.front());
  return exit_code::machine_failed;
}

bool draw_with_python(const fs::path& folder, const std::vector<std::string>& files, const fs::path& run) {
  std::vector<std::string> words = {"plot", "--quiet", "--run", run.string()};
  for (const std::string& file : files) words.push_back((folder / file).string());
  const int code = python(words, ChildOutput::silent);
  stop_if_interrupted();
  if (code == no_package || code == exit_code::machine_failed)
    warn(
        "no pictures: the Python package raytube draws them, and it or matplotlib is not installed; raytube plot DIR, with the "
        "folder of the results, draws them later");
  else if (code != 0)
    warn(fmt::format("no pictures: raytube plot failed; run it by hand on {} to see why", files.front()));
  return code == 0;
}

}  // namespace raytube
