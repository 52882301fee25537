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
#include "program/work/interrupt.h"
#include "ranks/ranks.h"

namespace {

using namespace raytube;

// For want of memory, or of room for the stack of a thread.
constexpr const char* too_little =
    "out of memory; earlier results are as they were. End other programs or raise the limit (ulimit -v, ulimit -u, the "
    "container's), take fewer --threads, or split the sweep";
constexpr int fell_short = 1, bad_input = 2;

// Beside the program where it was built, and where it is installed.
std::vector<std::filesystem::path> plugin_folders() {
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  return {folder, folder / RAYTUBE_PLUGINS};
}

// Those whose work can be shared.
void require_shareable(Command command) {
  for (const Command shared : {Command::run, Command::converge, Command::profile, Command::isar, Command::none})
    if (command == shared) return;
  throw InputError("this command does not share its work among processes; start one alone, without mpirun");
}

// Those of a job that do not lead it do not talk, and end with it: who interrupts the job interrupts rank 0, which has looks to
// keep and a sentence to say.
void be_quiet() {
  [[maybe_unused]] const bool is_closed = std::freopen("/dev/null", "w", stdout) != nullptr;
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
}

void execute(const Request& request) {
  if (!request.instruction_set.empty()) limit_instruction_set(request.instruction_set);
  if (request.ranks) require_shareable(request.command);
  if (request.ranks && !request.ranks->leads() && request.command != Command::none) return help_command(request);
  switch (request.command) {
    case Command::run:
      return run_command(request);
    case Command::check:
      return check_command(request);
    case Command::trace:
      return trace_command(request);
    case Command::compare:
      return compare_command(request);
    case Command::converge:
      return converge_command(request);
    case Command::convert:
      return convert_command(request);
    case Command::sources:
      return sources_command(request);
    case Command::profile:
      return profile_command(request);
    case Command::isar:
      return isar_command(request);
    case Command::centres:
      return centres_command(request);
    case Command::plot:
      return plot_command(request.plot);
    case Command::statistics:
      return statistics_command(request.statistics);
    case Command::report:
      return report_command(request);
    case Command::merge:
      return merge_command(request);
    case Command::none:
      return;
  }
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
    execute(request);
    if (ranks) ranks->end();
    require_printed();
    return 0;
  } catch (const InputError& error) {
    return complain(ranks, error.what(), bad_input);
  } catch (const RankFailed& failure) {
    return complain(ranks, failure.what(), failure.code());
  } catch (const Interrupted& interruption) {
    return complain(ranks, interruption.what(), code_of_an_interrupt);
  } catch (const std::bad_alloc&) {
    return complain(ranks, too_little, fell_short);
  } catch (const std::system_error& error) {
    return complain(ranks, error.code() == std::errc::resource_unavailable_try_again ? too_little : error.what(), fell_short);
  } catch (const std::exception& error) {
    if (for_want_of_a_thread(error)) return complain(ranks, too_little, fell_short);
    return complain(ranks, std::ferror(stdout) ? not_printed : error.what(), fell_short);
  }
}
