#include "program/run/finished_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "jobs/shared_work.h"
#include "output/files/earlier_results.h"
#include "program/work/look_journal.h"

namespace raytube {

namespace {

JournalIdentity identity_without_program(const PreparedRun& prepared) {
  JournalIdentity identity = identity_of(prepared.c, prepared.manifest);
  std::erase_if(identity, [](const auto& item) { return item.first == program_item; });
  return identity;
}

}  // namespace

bool is_finished(const Request& request, const PreparedRun& prepared, const Destination& destination) {
  const std::filesystem::path& folder = destination.folder;
  const EarlierResults earlier(folder);
  if (std::filesystem::exists(LookJournal::file_in(folder)) || !earlier.hold("run.json")) return false;
  std::ifstream file(folder / "run.json");
  const Json run = Json::parse(file);
  if (const std::string found = differences_text(identity_of_run(run), identity_without_program(prepared)); !found.empty())
    throw InputError(
        fmt::format("--resume: {} holds the results of a finished run with {}; choose another folder with -o DIR, or "
                    "leave out --resume to replace them",
                    folder.string(), found));
  return std::ranges::all_of(names_of_results(request, prepared.c, destination).tables,
                             [&](const std::string& name) { return earlier.hold(name); });
}

}  // namespace raytube
