#include "case/text/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/csv_reader.h"
#include "core/decimal.h"
#include "core/text.h"

namespace raytube {

namespace {

using Kind = CaseValue::Kind;

constexpr double most_values = 1e6;
constexpr double coarsest_angle = 1e-6;  // [deg]: the finest lobes there are, of 10^6 wavelengths, are thirty times as wide

constexpr std::array<std::string_view, 6> units = {"m", "cm", "mm", "um", "in", "ft"};
constexpr std::array<double, 6> metres = {1.0, 1e-2, 1e-3, 1e-6, 0.0254, 0.3048};

struct Range {
  double start, stop, third;  // third: step or count
};

void check_range_keys(const CaseValue& table, const std::string& key) {
  for (std::size_t i = 0; i < table.keys.size(); ++i)
    if (const std::string& name = table.keys[i]; name != "start" && name != "stop" && name != "step" && name != "count")
      reject(table.items[i],
             fmt::format("unknown key \"{0}.{1}\"; write {0} = {{ start, stop, step }} or {{ start, stop, count }}", key,
                         quotable(name)));
  if (table.find("step") && table.find("count")) reject(table, key + " has both a step and a count; leave one of them out");
  if (!table.find("step") && !table.find("count"))
    reject(table,
           fmt::format("{0} has neither step nor count; write {0} = {{ start = ..., stop = ..., step = ... }}, or count = ... "
                       "in the place of step",
                       key));
}

Range read_range(const CaseValue& table, const std::string& key, std::string_view third) {
  const auto entry = [&](std::string_view name) {
    const CaseValue* value = table.find(name);
    if (!value)
      reject(table, fmt::format("{0} has no {1}; write {0} = {{ start = ..., stop = ..., {2} = ... }}", key, name, third));
    return read_number(*value, fmt::format("{}.{}", key, name));
  };
  return {entry("start"), entry("stop"), entry(third)};
}

void check_count(const CaseValue& table, const std::string& key, double count, std::string_view third) {
  if (count > most_values)
    reject(table, fmt::format("{} asks for {:.7g} values, more than the {:.0f} allowed; choose another {}", key, count,
                              most_values, third));
}

std::vector<double> equally_spaced(const CaseValue& table, const std::string& key, double start, double step, std::size_t count) {
  const double larger_end = std::max(std::abs(start), std::abs(start + step * static_cast<double>(count - 1)));
  std::vector<double> values(count);
  // Not start += step, which would add up rounding errors.
  for (std::size_t i = 0; i < count; ++i) values[i] = rounded_at_scale(start + static_cast<double>(i) * step, larger_end);
  values.front() = start;
  if (step != 0.0 && std::ranges::adjacent_find(values) != values.end())
    reject(table, fmt::format("{} has steps of {}, which numbers of the size of {} do not resolve; choose larger steps", key,
                              number_text(step), number_text(larger_end)));
  return values;
}

std::string stops_early(const CaseValue& table, const std::string& key, double last) {
  const auto [start, stop, step] = read_range(table, key, "step");
  return fmt::format(
      "{}: {}: steps of {} from {} end at {}, short of stop = {}; to reach it write count = {} in the place of step, "
      "or else stop = {}",
      table.location, key, number_text(step), number_text(start), number_text(last), number_text(stop),
      std::max(std::round((stop - start) / step), 1.0) + 1.0, number_text(last));
}

std::vector<double> stepped_range(const CaseValue& table, const std::string& key, std::vector<std::string>& warnings) {
  const auto [start, stop, step] = read_range(table, key, "step");
  if (step == 0.0) reject(table, key + ".step must not be zero; write a single number for a single value");
  const double steps = (stop - start) / step;
  if (steps < 0.0)
    reject(table,
           fmt::format("{}.step {} leads away from stop (start {}, stop {}); write step = {}", key, step, start, stop, -step));
  const double whole = std::floor(steps + 1e-9);
  check_count(table, key, whole + 1.0, "step");
  std::vector<double> values = equally_spaced(table, key, start, step, static_cast<std::size_t>(whole) + 1);
  if (std::abs(steps - whole) <= 1e-9)
    values.back() = stop;
  else
    warnings.push_back(stops_early(table, key, values.back()));
  return values;
}

std::vector<double> counted_range(const CaseValue& table, const std::string& key) {
  const auto [start, stop, count] = read_range(table, key, "count");
  if (count < 1.0 || count != std::floor(count))
    reject(table, fmt::format("{}.count must be a whole number of at least 1 (found {})", key, count));
  check_count(table, key, count, "count");
  if (count == 1.0 && start != stop) reject(table, key + ".count of 1 cannot hold both start and stop; write count = 2 or more");
  if (count == 1.0) return {start};
  std::vector<double> values = equally_spaced(table, key, start, (stop - start) / (count - 1.0), static_cast<std::size_t>(count));
  values.back() = stop;
  return values;
}

// "first:step:last", as others write a range, or "first:last" by 1.
std::optional<Range> range_with_colons(const CaseValue& value) {
  std::vector<double> parts;
  for (std::size_t at = 0; value.kind == Kind::text && at <= value.text.size();) {
    const std::size_t end = std::min(value.text.find(':', at), value.text.size());
    const std::optional<double> part = parsed_number(value.text.substr(at, end - at));
    if (!part || parts.size() == 3) return {};
    parts.push_back(*part);
    at = end + 1;
  }
  if (parts.size() < 2) return {};
  return Range{parts.front(), parts.back(), parts.size() == 3 ? parts[1] : 1.0};
}

[[noreturn]] void reject_values(const CaseValue& value, const std::string& key) {
  const std::string forms = fmt::format("{} must be a number, a list or {}", key, range_forms);
  const std::optional<Range> meant = range_with_colons(value);
  const double steps = meant ? std::floor((meant->stop - meant->start) / meant->third + 1e-9) : -1.0;
  if (!(steps >= 0.0 && std::isfinite(steps))) reject(value, forms);
  const auto [start, stop, step] = *meant;
  reject(value, fmt::format("{}; for {} write {{ start = {}, stop = {}, step = {} }}", forms, quotable(value.text),
                            number_text(start), number_text(rounded_at_scale(start + steps * step, stop)), number_text(step)));
}

std::vector<double> listed(const CaseValue& list, const std::string& key) {
  if (list.items.empty()) reject(list, key + " is an empty list; give at least one number");
  std::vector<double> values;
  for (const CaseValue& item : list.items) values.push_back(read_number(item, "every entry of " + key));
  return values;
}

}  // namespace

double read_number(const CaseValue& value, const std::string& key) {
  if (value.kind != Kind::number) reject(value, key + " must be a number, without quotes");
  if (!std::isfinite(value.number)) reject(value, key + " must be a finite number");
  return value.number == 0.0 ? 0.0 : value.number;  // never -0
}

std::string unresolved_angle(const std::string& key, double degrees) {
  const double apart = std::nextafter(std::abs(degrees), std::numeric_limits<double>::infinity()) - std::abs(degrees);
  if (apart <= coarsest_angle) return {};
  return fmt::format("{} is {}, too large for an angle in double precision; write an angle from -360 to 360", key, degrees);
}

double read_in(const CaseValue& value, const std::string& key, const Limits& limits) {
  const double number = read_number(value, key);
  if (!limits.hold(number)) reject(value, fmt::format("{} must be {} (found {})", key, limits.text(), number));
  return number;
}

int read_whole(const CaseValue& value, const std::string& key, const Limits& limits) {
  const double number = read_number(value, key);
  if (!limits.hold(number) || number != std::floor(number))
    reject(value, fmt::format("{} must be a whole number {} (found {})", key, limits.text(), number));
  return static_cast<int>(number);
}

bool read_flag(const CaseValue& value, const std::string& key) {
  if (value.kind != Kind::boolean) reject(value, key + " must be true or false, without quotes");
  return value.boolean;
}

dvec3 read_vector(const CaseValue& value, const std::string& key) {
  if (value.kind != CaseValue::Kind::list || value.items.size() != 3)
    reject(value, key + " must be a list of three numbers, for example [0, 0, 1]");
  const auto entry = [&](std::size_t i) { return read_number(value.items[i], "every entry of " + key); };
  return {entry(0), entry(1), entry(2)};
}

std::vector<dvec3> read_vectors(const CaseValue& value, const std::string& key) {
  const bool several =
      value.kind == CaseValue::Kind::list && !value.items.empty() && value.items[0].kind == CaseValue::Kind::list;
  if (!several) return {read_vector(value, key)};
  std::vector<dvec3> vectors;
  for (const CaseValue& item : value.items) vectors.push_back(read_vector(item, "every entry of " + key));
  return vectors;
}

std::string read_text(const CaseValue& value, const std::string& key) {
  if (value.kind != Kind::text) reject(value, key + " must be a text in double quotes");
  return value.text;
}

std::size_t read_word(const CaseValue& value, const std::string& key, std::span<const std::string_view> words) {
  const std::string text = read_text(value, key);
  const auto found = std::ranges::find(words, text);
  if (found == words.end())
    reject(value, fmt::format("{} \"{}\" is unknown; write \"{}\" or \"{}\"", key, quotable(text),
                              joined(words.first(words.size() - 1), "\", \""), words.back()));
  return found - words.begin();
}

std::string read_file_name(const CaseValue& value, const std::string& key, const std::string& what) {
  std::string name = read_text(value, key);
  if (name.empty()) reject(value, fmt::format("{} is empty; give the file of the {}, relative to the case file", key, what));
  const auto control = [](unsigned char c) { return c < ' ' || c == 127; };
  if (std::ranges::any_of(name, control))
    reject(value,
           fmt::format("{} holds a control character, which \"\\t\", \"\\n\" and the like stand for; write / between folders, or "
                       "put the path in 'single quotes'",
                       key));
  return name;
}

double read_unit(const CaseValue& value, const std::string& key) { return metres[read_word(value, key, units)]; }

std::vector<double> read_values(const CaseValue& value, const std::string& key, std::vector<std::string>& warnings) {
  if (value.kind == Kind::list) return listed(value, key);
  if (value.kind == Kind::number) return {read_number(value, key)};
  if (value.kind != Kind::table) reject_values(value, key);
  check_range_keys(value, key);
  return value.find("count") ? counted_range(value, key) : stepped_range(value, key, warnings);
}

}  // namespace raytube
