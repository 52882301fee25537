#include "case/materials/medium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/materials/media.h"
#include "case/materials/medium_csv.h"
#include "case/text/keys.h"
#include "case/text/values.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

// 1 / (mu_0 c^2), mu_0 of CODATA 2018 [F/m].
constexpr double vacuum_permittivity = 1.0 / (1.25663706212e-6 * speed_of_light * speed_of_light);

// Beyond this a product of two overflows in the end, and no medium lies there.
constexpr double most_relative = 1e30;

// A number, or [real part, loss].
std::array<double, 2> read_pair(const CaseValue& value, const std::string& key) {
  const bool list = value.kind == CaseValue::Kind::list && value.items.size() == 2;
  if (!list && value.kind != CaseValue::Kind::number)
    reject(value, fmt::format("{} must be a number, or [real part, loss] for example [6.5, 0.1]", key));
  if (!list) return {read_number(value, key), 0.0};
  return {read_number(value.items[0], "every entry of " + key), read_number(value.items[1], "every entry of " + key)};
}

std::array<double, 2> read_relative(const CaseValue& value, const std::string& key) {
  const auto [real, loss] = read_pair(value, key);
  if (loss < 0.0)
    reject(value, fmt::format("{} has a gain: in {} losses are not below 0; write [{}, {}]", key, loss_convention(key),
                              number_text(real), number_text(-loss)));
  if (real == 0.0) reject(value, key + " must not be 0; vacuum has 1");
  return {real, loss};
}

double read_loss(const CaseValue& value, const std::string& key) {
  const double loss = read_number(value, key);
  if (loss < 0.0)
    reject(value, fmt::format("{} is a gain (found {}): in {} losses are not below 0; write {}", key, number_text(loss),
                              loss_convention(key), number_text(-loss)));
  return loss;
}

// Of several keys that say the same, the one that is there; another one beside it is refused.
const CaseValue* only_one(const CaseValue& table, const std::string& path, std::initializer_list<const char*> keys) {
  const CaseValue* found = nullptr;
  std::string_view first;
  for (const char* key : keys) {
    const CaseValue* value = table.find(key);
    if (value && found)
      reject(*value, {found}, fmt::format("{}.{} cannot be combined with {}; remove one of them", path, key, first));
    if (value) first = key, found = value;
  }
  return found;
}

void read_numbers(const CaseValue& table, const std::string& path, MediumChoice& medium) {
  const CaseValue& eps = *table.find("eps_r");
  medium.eps_r = read_relative(eps, path + ".eps_r");
  if (const CaseValue* mu = table.find("mu_r")) medium.mu_r = read_relative(*mu, path + ".mu_r");
  const CaseValue* loss = only_one(table, path, {"loss_tangent", "conductivity_s_per_m"});
  if (!loss) return;
  const bool is_tangent = table.find("loss_tangent") != nullptr;
  const std::string key = path + (is_tangent ? ".loss_tangent" : ".conductivity_s_per_m");
  if (eps.kind == CaseValue::Kind::list)
    reject(*loss, {&eps},
           fmt::format("{} cannot be combined with a loss in eps_r; write eps_r = {}", key, number_text(medium.eps_r[0])));
  (is_tangent ? medium.loss_tangent : medium.conductivity) = read_loss(*loss, key);
  if (is_tangent && medium.eps_r[0] < 0.0)
    reject(*loss, {&eps}, fmt::format("{} needs an eps_r above 0; write eps_r = [eps', eps''] instead", key));
}

void refuse_numbers(const CaseValue& table, const std::string& path, std::string_view instead) {
  for (const char* key : {"mu_r", "loss_tangent", "conductivity_s_per_m"})
    if (const CaseValue* value = table.find(key))
      reject(*value, {table.find(instead)},
             fmt::format("{}.{} cannot be combined with {}, which says it; remove one of them", path, key, instead));
}

std::string read_medium_name(const CaseValue& value, const std::string& key) {
  const std::string name = read_text(value, key);
  const std::vector<std::string> known = library_names();
  if (std::ranges::find(known, name) != known.end()) return name;
  const std::string meant = medium_meant(name);
  reject(value, fmt::format("{} \"{}\" is not in the library; write {}", key, quotable(name),
                            meant.empty() ? joined(known, ", ") : fmt::format("\"{}\"", meant)));
}

Medium medium_of_numbers(const MediumChoice& choice, double frequency) {
  double loss = choice.eps_r[1];
  if (choice.loss_tangent) loss = choice.eps_r[0] * *choice.loss_tangent;
  if (choice.conductivity) loss = *choice.conductivity / (2.0 * pi * frequency * vacuum_permittivity);
  return {{choice.eps_r[0], -loss}, {choice.mu_r[0], -choice.mu_r[1]}};
}

std::string location_of(const MediumChoice& choice) { return fmt::format("{}: {}", choice.location, choice.key); }

// Frequencies from the command line are what went wrong, rather than a line of the file.
std::string location_of(const MediumChoice& choice, const std::string& asked_at) {
  const bool asked_too_much = is_override(asked_at) && !is_override(choice.location);
  return fmt::format("{}: {}", asked_too_much ? asked_at : choice.location, choice.key);
}

Medium medium_of_library(const MediumChoice& choice, double frequency, const std::string& asked_at) {
  try {
    return *library_medium(choice.medium, frequency);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", location_of(choice, asked_at), error.what()));
  }
}

Medium medium_of_table(const MediumTable& table, const MediumChoice& choice, double frequency, const std::string& asked_at) {
  if (frequency < table.frequencies.front() || frequency > table.frequencies.back())
    throw InputError(
        fmt::format("{} \"{}\" goes from {} to {} GHz, but frequency.ghz contains {}; choose frequencies within, or "
                    "another table",
                    location_of(choice, asked_at), quotable(choice.table_csv), number_text(table.frequencies.front() / 1e9),
                    number_text(table.frequencies.back() / 1e9), number_text(frequency / 1e9)));
  return table.at(frequency);
}

void check_size(const Complex& relative, std::string_view name, const MediumChoice& choice, double frequency) {
  if (const double size = std::abs(relative); !(size > 1.0 / most_relative && size < most_relative))
    throw InputError(
        fmt::format("{}: {} is {:.3g} in size at {} GHz, which is not a medium's; correct it, or write kind = \"pec\"",
                    location_of(choice), name, size, number_text(frequency / 1e9)));
}

void check_medium(const Medium& medium, const MediumChoice& choice, double frequency) {
  check_size(medium.permittivity, "eps_r", choice, frequency);
  check_size(medium.permeability, "mu_r", choice, frequency);
  const bool lossless = medium.permittivity.imag() == 0.0 && medium.permeability.imag() == 0.0;
  if (!lossless) return;
  // Only a loss tells waves that go on from waves that come back, and those would be a gain.
  const bool negative_eps = medium.permittivity.real() < 0.0, negative_mu = medium.permeability.real() < 0.0;
  if (negative_eps && negative_mu)
    throw InputError(fmt::format("{}: eps_r and mu_r are both below 0 at {} GHz; give one of them a loss", location_of(choice),
                                 number_text(frequency / 1e9)));
  // Legal, but no medium: what is below 0 is near a resonance or a plasma, and these have losses. A wrong sign is far likelier.
  if (negative_eps || negative_mu)
    throw InputError(
        fmt::format("{}: {} is below 0 at {} GHz and has no loss, which no medium is; correct the sign, or write "
                    "[real part, loss] with a loss above 0",
                    location_of(choice), negative_eps ? "eps_r" : "mu_r", number_text(frequency / 1e9)));
}

}  // namespace

MediumChoice read_medium(const CaseValue& table, const std::string& path) {
  MediumChoice medium;
  const CaseValue* given = only_one(table, path, {"eps_r", "table_csv", "medium"});
  if (!given) reject(table, {table.find("kind")}, path + ".eps_r is missing; add it, or table_csv or medium in its place");
  medium.location = given->location;
  if (table.find("eps_r")) {
    medium.key = path + ".eps_r";
    read_numbers(table, path, medium);
    return medium;
  }
  const std::string key = table.find("medium") ? "medium" : "table_csv";
  medium.key = path + '.' + key;
  refuse_numbers(table, path, key);
  if (key == "medium")
    medium.medium = read_medium_name(*given, path + ".medium");
  else
    medium.table_csv = read_text(*given, path + ".table_csv");
  if (key == "table_csv" && medium.table_csv.empty()) reject(*given, path + ".table_csv is empty; give the file of the table");
  return medium;
}

std::string medium_meant(std::string_view name) {
  const std::vector<std::string> known = library_names();
  const auto found = std::ranges::find(known, lower_case(name));
  return found == known.end() ? "" : *found;
}

std::vector<Medium> media_at(const MediumChoice& choice, const std::filesystem::path& folder, std::span<const double> frequencies,
                             const std::string& asked_at) {
  MediumTable table;
  if (!choice.table_csv.empty()) table = read_medium_csv(folder / choice.table_csv, location_of(choice));
  std::vector<Medium> media;
  for (const double frequency : frequencies) {
    media.push_back(!choice.table_csv.empty() ? medium_of_table(table, choice, frequency, asked_at)
                    : !choice.medium.empty()  ? medium_of_library(choice, frequency, asked_at)
                                              : medium_of_numbers(choice, frequency));
    check_medium(media.back(), choice, frequency);
  }
  return media;
}

}  // namespace raytube
