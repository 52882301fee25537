#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.h"
#include "core/instruction_set.h"
#include "program/commands.h"
#include "program/python.h"
#include "program/work/exit_codes.h"
#include "program/work/interrupt.h"
#include "ranks/ranks.h"

namespace {

using namespace raytube;

// For want of memory, or of room for the stack of a thread.
constexpr const char* too_little =
    "out of memory; earlier results are as they were. End other programs or raise the limit (ulimit -v, ulimit -u, the "
    "container's), take fewer --threads, or split the sweep";

// Beside the program where it was built, and where it is installed.
std::vector<std::filesystem::path> plugin_folders() {
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  return {folder, folder / RAYTUBE_PLUGINS};
}

// Those of a job that do not lead it do not talk, and end with it: who interrupts the job interrupts rank 0, which has looks to
// keep and a sentence to say.
void be_quiet() {
  [[maybe_unused]] const bool is_closed = std::freopen("/dev/null", "w", stdout) != nullptr;
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
}

int execute(const Request& request) {
  if (!request.action && !request.by_python) return 0;  // help or version was printed
  if (!request.instruction_set.empty()) limit_instruction_set(request.instruction_set);
  if (request.ranks && !request.shared)
    throw InputError("this command does not share its work among processes; start it without mpirun");
  if (request.ranks && !request.ranks->leads()) return help_command(request), 0;
  if (request.by_python || (request.action == compare_command && compares_images(request))) return run_python(request.words);
  return request.action(request), 0;
}

// One line that can be read, whatever a file name or a library's message holds: of a long one the beginning and the end.
int complain(Ranks* ranks, std::string sentence, int code) {
  constexpr std::size_t beginning = 350, end = 250;
  if (sentence.size() > beginning + end) sentence.replace(beginning, sentence.size() - beginning - end, " ... ");
  for (char& c : sentence)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
  const bool is_leader = ranks ? ranks->leads() : is_first_process();
  if (is_leader) fmt::print(stderr, "raytube: {}\n", sentence);
  if (ranks) ranks->fail(code, sentence);
  return code;
}

// Of TBB, which says so in words alone.
bool for_want_of_a_thread(const std::exception& error) { return std::string_view(error.what()).starts_with("pthread_create"); }

// A file that is opened where stdout was closed would take what is printed.
void open_standard_streams() {
  for (int stream = open("/dev/null", O_RDWR); stream >= 0; stream = open("/dev/null", O_RDWR)) {
    if (stream <= STDERR_FILENO) continue;
    close(stream);
    return;
  }
}

constexpr const char* not_printed = "standard output: cannot be written completely; is the disk full? Send it elsewhere";

// What is printed waits in buffers, and is lost without a word on a full device.
void require_printed() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw std::runtime_error(not_printed);
}

}  // namespace

int main(int argc, char** argv) {
  std::unique_ptr<Ranks> job;
  Ranks* ranks = nullptr;
  try {
    open_standard_streams();
    end_on_interrupt();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a write that fails, as on a full disk
    job = launched_ranks(plugin_folders());
    ranks = job.get();
    if (ranks && !ranks->leads()) be_quiet();
    Request request = parse_command_line(argc, argv);
    request.ranks = ranks;
    if (ranks && request.threads == 0) request.threads = ranks->threads();
    if (request.action == run_command) make_case_of_mesh(request);
    const int code = execute(request);
    if (ranks) ranks->end();
    require_printed();
    return code;
  } catch (const InputError& error) {
    return complain(ranks, error.what(), exit_code::bad_input);
  } catch (const AboveTolerance& found) {
    return complain(ranks, found.what(), exit_code::above_tolerance);
  } catch (const UnusableRows& found) {
    return complain(ranks, found.what(), exit_code::unusable_rows);
  } catch (const RankFailed& failure) {
    return complain(ranks, failure.what(), failure.code());
  } catch (const Interrupted& interruption) {
    return complain(ranks, interruption.what(), code_of_an_interrupt);
  } catch (const std::bad_alloc&) {
    return complain(ranks, too_little, exit_code::machine_failed);
  } catch (const std::system_error& error) {
    return complain(ranks, error.code() == std::errc::resource_unavailable_try_again ? too_little : error.what(),
                    exit_code::machine_failed);
  } catch (const std::exception& error) {
    if (for_want_of_a_thread(error)) return complain(ranks, too_little, exit_code::machine_failed);
    return complain(ranks, std::ferror(stdout) ? not_printed : error.what(), exit_code::machine_failed);
  }
}
