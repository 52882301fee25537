#include "program/work/results.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <system_error>

#include "core/error.h"
#include "output/files/earlier_results.h"
#include "output/files/sync.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

Names first_and_second(const Names& first, const Names& second) {
  Names all = first;
  all.insert(all.end(), second.begin(), second.end());
  return all;
}

Names written(const NewResults& results, const Names& names) {
  Names found;
  for (const std::string& name : names)
    if (fs::exists(results.folder() / name)) found.push_back(name);
  return found;
}

void refuse_inputs(const fs::path& folder, const Names& names, const std::vector<InputFile>& inputs) {
  for (const std::string& name : names)
    for (const auto& [key, file] : inputs) {
      std::error_code ignored;
      if (fs::equivalent(folder / name, file, ignored))
        throw InputError(
            fmt::format("{}: is an input ({}), and a result of that name would replace it; choose another folder with -o DIR",
                        (folder / name).string(), key));
    }
}

Names with_room(const EarlierResults& earlier, const Names& pictures) {
  Names free;
  for (const std::string& name : pictures) try {
      earlier.require_room({name});
      free.push_back(name);
    } catch (const InputError& error) {
      warn(fmt::format("no plot: {}", error.what()));
    }
  return free;
}

Names held(const EarlierResults& earlier, const Names& names) {
  Names there;
  for (const std::string& name : names)
    if (earlier.hold(name)) there.push_back(name);
  return there;
}

void place_pictures(NewResults& results, const Names& pictures) {
  try {
    results.place(pictures);
  } catch (const std::runtime_error& error) {
    warn(fmt::format("no plot: {}", error.what()));
  }
}

}  // namespace

void warn(const std::string& sentence) { fmt::print(stderr, "raytube: {}\n", sentence); }

void stop_if_interrupted() {
  if (!InterruptFlag::raised()) return;
  InterruptFlag::leaving();
  throw Interrupted();
}

void check_output(const fs::path& folder, const ResultNames& names, const std::vector<InputFile>& inputs) {
  const OutputFolder open(folder);
  const Names all = first_and_second(names.pictures, names.tables);
  refuse_inputs(open.path(), all, inputs);
  EarlierResults(open.path()).require_room(all);
}

void replace_results(NewResults& results, const fs::path& folder, const ResultNames& names, const Names& leftovers,
                     const std::function<void()>& placed) {
  EarlierResults earlier(folder);
  const Names tables = written(results, names.tables);
  earlier.require_room(tables);
  const Names pictures = with_room(earlier, written(results, names.pictures));
  const Names old = held(earlier, first_and_second(leftovers, first_and_second(names.pictures, names.tables)));
  results.sync();
  earlier.expect(results.folder(), first_and_second(pictures, tables));

  const std::unique_lock<std::mutex> results_change_places = hold_last_words();
  earlier.announce(results.folder());
  try {
    place_pictures(results, pictures);
    results.place(tables);
  } catch (...) {
    results.take_back();
    earlier.withdraw(results.folder());
    throw;
  }
  for (const std::string& name : old)
    if (!results.has_placed(name)) unlink((folder / name).c_str());  // unlike fs::remove, removes no folder
  earlier.settle(results.folder());
  sync_folder(folder);
  placed();
}

fs::path folder_of_named_file(const char* option, const fs::path& file, std::string_view head) {
  const fs::path folder = fs::absolute(file).parent_path();
  const fs::file_status found = fs::symlink_status(file);
  if (!fs::is_directory(folder) || (fs::exists(found) && !fs::is_regular_file(found)))
    throw InputError(
        fmt::format("{} {}: cannot be written; give an ordinary file in a folder that exists", option, file.string()));
  std::string first;
  if (std::ifstream in(file); in && std::getline(in, first) && first + '\n' != head)
    throw InputError(fmt::format("{} {}: is not an earlier result; name another file, or delete it", option, file.string()));
  return folder;
}

AllOrNothing::AllOrNothing(const fs::path& folder)
    : folder_(folder), interrupt_flag_([this]() -> std::optional<std::string> {
        if (complete_) return {};
        folder_.abandon();
        return Interrupted().what();
      }) {}

Names AllOrNothing::place(const ResultNames& names, const std::function<void(const fs::path&)>& write, const Names& leftovers) {
  folder_.require_there();
  NewResults results(folder());
  write(results.folder());
  replace_results(results, folder(), names, leftovers, [this] { complete_ = true; });
  Names placed = first_and_second(names.tables, names.pictures);
  std::erase_if(placed, [&](const std::string& name) { return !results.has_placed(name); });
  return placed;
}

}  // namespace raytube
