// Keys of case files: unknown ones, and near ones.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "case/text/document.h"

namespace raytube {

/// What a kind of case may hold.
struct KnownKeys {
  std::span<const std::string_view> names;                              // dotted
  std::span<const std::string_view> foreign_sections;                   // those of another kind of case,
  std::string_view foreign_command;                                     // and the command for it
  std::string_view listed_section = {};                                 // one that is a list of tables
  std::string_view (*remedy_for_word)(std::string_view key) = nullptr;  // for other programs' names of keys
};

/// Throws InputError at the first key that is unknown, naming what raytube has in its place, a near one, or all there are.
void check_keys(const CaseValue& root, const KnownKeys& known);

/// The same for the keys inside [materials].
void check_material_keys(const CaseValue& materials);

/// The same for the keys inside [motion.bodies].
void check_body_keys(const CaseValue& bodies);

/// The one of `known` dotted keys that `key` was most likely meant to be; empty if none is near.
std::string_view nearest_key(std::string_view key, std::span<const std::string_view> known);

/// The one of `known` names, of which there is at least one, that `name` was most likely meant to be; empty if none is near.
std::string_view nearest_name(std::string_view name, std::span<const std::string> known);

/// 'did you mean "NAME"?' for a near one, else "choose among" the first ones of all.
std::string name_meant(std::string_view name, std::span<const std::string> known);

}  // namespace raytube
