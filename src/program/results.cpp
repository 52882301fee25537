#include "program/results.h"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>
#include <system_error>

#include "error.h"
#include "output/earlier_results.h"
#include "program/interrupt.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

Names joined(const Names& first, const Names& second) {
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
            fmt::format("{}: is read here ({}), and a result of that name would replace it; choose another folder with -o DIR",
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

}  // namespace

void warn(const std::string& sentence) { fmt::print(stderr, "raytube: {}\n", sentence); }

void stop_if_interrupted() {
  if (!InterruptFlag::raised()) return;
  InterruptFlag::leaving();
  throw Interrupted();
}

void make_again_if_gone(OutputFolder& folder) {
  if (folder.make_again_if_gone()) warn(fmt::format("output folder {} was removed; it is made again", folder.path().string()));
}

void check_output(const fs::path& folder, const ResultNames& names, const std::vector<InputFile>& inputs) {
  const OutputFolder open(folder);
  const Names all = joined(names.pictures, names.tables);
  refuse_inputs(open.path(), all, inputs);
  EarlierResults(open.path()).require_room(all);
}

void replace_results(const NewResults& results, const fs::path& folder, const ResultNames& names, const Names& leftovers,
                     const std::function<void()>& placed) {
  EarlierResults earlier(folder);
  const Names tables = written(results, names.tables), pictures = with_room(earlier, written(results, names.pictures));
  earlier.require_room(tables);
  Names old;
  for (const std::string& name : joined(leftovers, joined(names.pictures, names.tables)))
    if (earlier.hold(name)) old.push_back(name);

  const NotNow results_change_places;
  earlier.announce(results.folder(), joined(pictures, tables));
  std::error_code ignored;
  for (auto name = old.rbegin(); name != old.rend(); ++name) fs::remove(folder / *name, ignored);
  try {
    results.place(pictures);
  } catch (const std::runtime_error& error) {
    warn(fmt::format("no plot: {}", error.what()));
  }
  results.place(tables);
  earlier.settle(results.folder());
  placed();
}

std::optional<std::string> AllOrNothing::last_words() const {
  if (complete_) return {};
  folder_.abandon();
  return Interrupted().what();
}

}  // namespace raytube
