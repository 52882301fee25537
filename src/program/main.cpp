#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
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
#include "program/commands.h"
#include "program/work/exit_codes.h"
#include "program/work/interrupt.h"
#include "ranks/ranks.h"

namespace {

using namespace raytube;

constexpr const char* out_of_memory =
    "out of memory; earlier results are as they were. End other programs or raise the limit (ulimit -v, ulimit -u, the "
    "container's), take fewer --threads, or split the sweep";

// The plugins lie beside a program that was built, and in a folder of their own once it is installed.
std::vector<std::filesystem::path> plugin_folders() {
  std::error_code ignored;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  return {folder, folder / RAYTUBE_PLUGINS};
}

// Processes that do not lead their job print nothing and end with it: an interrupt is for rank 0, which keeps the looks and
// prints the sentence.
void be_quiet() {
  [[maybe_unused]] const bool is_closed = std::freopen("/dev/null", "w", stdout) != nullptr;
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_IGN);
}

// Prints one readable line, whatever a file name or a library's message contains: the beginning and the end of a long one.
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

// If stdout is closed, the next file that is opened takes its place, and receives everything that is printed.
void open_standard_streams() {
  for (int stream = open("/dev/null", O_RDWR); stream >= 0; stream = open("/dev/null", O_RDWR)) {
    if (stream <= STDERR_FILENO) continue;
    close(stream);
    return;
  }
}

constexpr const char* not_printed = "standard output: cannot be written completely; is the disk full? Send it elsewhere";

// Printed text waits in buffers, and is lost silently on a full device.
void require_printed() {
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw std::runtime_error(not_printed);
}

// The GNU allocator keeps what was freed between other arrays for later, of arrays of up to 32 MB once there was one: a tenth of
// what a large mesh takes. With fixed limits arrays from 4 MB on go back to the system.
void return_freed_memory() {
#ifdef M_MMAP_THRESHOLD
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 8 << 20);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  std::unique_ptr<Ranks> job;
  Ranks* ranks = nullptr;
  return_freed_memory();
  try {
    open_standard_streams();
    end_on_interrupt();
    std::signal(SIGXFSZ, SIG_IGN);  // at the limit of a file's size a write fails, as on a full disk
    job = launched_ranks(plugin_folders());
    ranks = job.get();
    if (ranks && !ranks->leads()) be_quiet();
    const int code = run_command_line(argc, argv, ranks);
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
    return complain(ranks, out_of_memory, exit_code::machine_failed);
  } catch (const std::system_error& error) {
    return complain(ranks, error.code() == std::errc::resource_unavailable_try_again ? out_of_memory : error.what(),
                    exit_code::machine_failed);
  } catch (const std::exception& error) {
    if (std::string_view(error.what()).starts_with("pthread_create"))  // by which TBB says that it cannot have a thread
      return complain(ranks, out_of_memory, exit_code::machine_failed);
    return complain(ranks, std::ferror(stdout) ? not_printed : error.what(), exit_code::machine_failed);
  }
}
