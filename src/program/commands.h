// The room of the program: the command line, and nothing that another program could want.
//
//     command_line  the list of commands, their help, and the sentences about unknown words;  main: exceptions -> exit codes
//     options       options that several commands have
//     run/          raytube run and merge: a case into its folder, or shards of it
//     check, trace, compare, converge, convert, profile, isar, doppler, centres: each command with its options and its help
//     helping       several processes at one command;  python: commands and pictures of the Python package
//     products      what profile, isar, doppler and centres have in common;  images: the images of a run
//     work/         where files go (destination), how they get there (results), interrupts (interrupt, look_journal), progress
//
// This file: the command line while it is parsed, and the functions by which each command adds itself to it.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace raytube {

class Ranks;

struct CommandLine {
  CLI::App& app;
  Ranks* ranks;                    // the job that this process belongs to; null: the process is alone
  std::vector<std::string> words;  // for the Python package
  int exit_code = 0;
};

CLI::App& add_command(CommandLine& line, const char* name, const char* description, const char* examples);

/// Sets what the command does once the whole line is parsed, and returns the command. `help`: what a process of a job does that
/// does not lead it; a command without `help` refuses to be shared between processes.
CLI::App& set_action(CommandLine& line, CLI::App& command, std::function<void()> act, std::function<void()> help = {});

/// Parses the command line and does what it asks for. Returns the exit code; throws InputError for a command line that cannot be
/// understood, and what the command throws.
int run_command_line(int argc, const char* const* argv, Ranks* ranks);

CLI::App& add_run(CommandLine& line);
CLI::App& add_merge(CommandLine& line);
CLI::App& add_converge(CommandLine& line);
CLI::App& add_profile(CommandLine& line);
CLI::App& add_isar(CommandLine& line);
CLI::App& add_doppler(CommandLine& line);
CLI::App& add_centres(CommandLine& line);
CLI::App& add_sources(CommandLine& line);  // point_source/command.cpp
CLI::App& add_check(CommandLine& line);
CLI::App& add_trace(CommandLine& line);
CLI::App& add_compare(CommandLine& line);
CLI::App& add_convert(CommandLine& line);

}  // namespace raytube
