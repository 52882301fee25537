#include <fmt/format.h>

#include <cctype>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "error.h"
#include "instruction_set.h"
#include "program/commands.h"
#include "program/interrupt.h"

namespace {

using namespace raytube;

constexpr int fell_short = 1, bad_input = 2, interrupted = 130;

void execute(const Request& request) {
  if (!request.instruction_set.empty()) limit_instruction_set(request.instruction_set);
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
    case Command::sources:
      return sources_command(request);
    case Command::none:
      return;
  }
}

// One line that can be read, whatever a file name or a library's message holds: of a long one the beginning and the end.
int complain(std::string sentence, int code) {
  constexpr std::size_t beginning = 350, end = 250;
  if (sentence.size() > beginning + end) sentence.replace(beginning, sentence.size() - beginning - end, " ... ");
  for (char& c : sentence)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
  fmt::print(stderr, "raytube: {}\n", sentence);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    end_on_interrupt();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a write that fails, as on a full disk
    execute(parse_command_line(argc, argv));
    return 0;
  } catch (const InputError& error) {
    return complain(error.what(), bad_input);
  } catch (const Interrupted& interruption) {
    return complain(interruption.what(), interrupted);
  } catch (const std::bad_alloc&) {
    return complain("out of memory; lower tubes.per_wavelength or split the sweep", fell_short);
  } catch (const std::exception& error) {
    return complain(error.what(), fell_short);
  }
}
