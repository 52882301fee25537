#include "program/results.h"

#include <fmt/format.h>

#include <stdexcept>

#include "error.h"
#include "program/interrupt.h"

namespace raytube {

void warn(const std::string& sentence) { fmt::print(stderr, "raytube: {}\n", sentence); }

void stop_if_interrupted() {
  if (!InterruptFlag::raised()) return;
  InterruptFlag::leaving();
  throw Interrupted();
}

std::string without_results(const OutputFolder& folder) {
  folder.abandon();
  return Interrupted().what();
}

void replace_results(const NewResults& results, const std::filesystem::path& folder, const std::vector<std::string>& pictures,
                     const std::vector<std::string>& tables, const std::function<void()>& placed) {
  const NotNow results_change_places;
  std::error_code ignored;
  for (auto name = std::rbegin(tables); name != std::rend(tables); ++name) std::filesystem::remove(folder / *name, ignored);
  for (const std::string& name : pictures) std::filesystem::remove(folder / name, ignored);
  try {
    results.place(pictures);
  } catch (const std::runtime_error& error) {
    warn(fmt::format("no plot: {}", error.what()));
  }
  results.place(tables);
  if (placed) placed();
}

}  // namespace raytube
