#include "output/report/words_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "output/products/sweep_samples.h"
#include "output/tables/csv.h"
#include "output/tables/cuts.h"
#include "output/tables/stored.h"
#include "output/words/summary.h"

namespace raytube {

namespace {

constexpr std::size_t longest_list = 8;

std::string extent_text(const std::vector<JsonValue>& numbers) {
  const auto [least, most] = std::ranges::minmax_element(numbers, {}, &JsonValue::number);
  return fmt::format("{} values from {:g} to {:g}", numbers.size(), least->number, most->number);
}

JsonValue shortened(const JsonValue& value) {
  JsonValue shorter = value;
  for (JsonValue& item : shorter.items) item = shortened(item);
  if (value.kind != JsonValue::Kind::list || value.items.size() <= longest_list) return shorter;
  if (std::ranges::all_of(value.items, [](const JsonValue& item) { return item.kind == JsonValue::Kind::number; }))
    return extent_text(value.items);
  return fmt::format("a list of {}", value.items.size());
}

// The result as the summary of a run takes it.
SweepResult summarised(const StoredResult& result) {
  SweepResult whole;
  whole.total = result.s;
  whole.error = errors_in_metres(result);
  whole.model = model_in_metres(result);
  return whole;
}

std::string peak_sentence(const StoredResult& result, const SweepResult& whole) {
  const std::size_t row = peak_row(whole);
  std::size_t strongest = 0;
  const auto level = [&](std::size_t channel) { return sigma_dbsm(whole.total[row].s[channel / 2][channel % 2]); };
  for (std::size_t channel = 1; channel < 4; ++channel)
    if (level(channel) > level(strongest)) strongest = channel;
  std::string name = channel_names[strongest];
  for (char& c : name) c = static_cast<char>(c - 'a' + 'A');
  const Sweep sweep = sweep_of(result);
  const std::size_t look = row / result.frequency_hz.size();
  return fmt::format(
      "The strongest return is {:.2f} dBsm, in {}, at {:g} GHz, \u03b8 = {:g}\u00b0, \u03c6 = {:g}\u00b0 (look {}).",
      level(strongest), name, result.frequency_hz[row % result.frequency_hz.size()] / 1e9, result.looks[look].theta_deg,
      result.looks[look].phi_deg, look);
}

// What the uncertainty mostly is, as run.json has it.
std::string largest_part(const JsonValue& run) {
  const JsonValue* parts = run.find("model_uncertainty");
  if (!parts || parts->items.empty()) return "";
  const JsonValue& largest = parts->items.front();
  const JsonValue *what = largest.find("what"), *share = largest.find("share"), *remedy = largest.find("remedy");
  if (!what || !share || !remedy) return "";
  return " It is " + largest_part_text({.name = {}, .what = what->text, .remedy = remedy->text, .share = share->number}) + ".";
}

}  // namespace

JsonValue sentences_json(const StoredResult& result, const JsonValue& run) {
  const SweepResult whole = summarised(result);
  return {{"peak", peak_sentence(result, whole)},
          {"error", "Numerical error of the tubes: " + numerical_error_text(whole) + "."},
          {"model",
           "Model uncertainty, what asymptotic physics leaves out: " + model_uncertainty_text(whole) + "." + largest_part(run)}};
}

JsonValue record_json(const JsonValue& run) {
  JsonValue record;
  for (const char* name : {"version", "case", "mesh", "threads", "warnings", "counts", "model_uncertainty", "time"})
    if (const JsonValue* value = run.find(name)) record[name] = shortened(*value);
  // These are read one by one, however many there are.
  for (const char* name : {"warnings", "model_uncertainty"})
    if (const JsonValue* value = run.find(name)) record[name] = *value;
  if (const JsonValue* counts = run.find("counts"))
    for (const char* name : {"skipped", "mechanisms"})
      if (const JsonValue* value = counts->find(name)) record["counts"][name] = *value;
  return record;
}

}  // namespace raytube
