// What the target is made of: [materials].
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "case/data/case.h"
#include "case/text/document.h"

namespace raytube {

/// Fills c.assignment, c.materials and c.sweep.materials; frequencies must be known already. Throws InputError.
void read_materials(const CaseValue& root, Case& c);

/// One of c.materials at the frequencies of the sweep; these are `asked_at`, for sentences. Throws InputError.
Material material_of(const MaterialChoice& choice, const Case& c, const std::string& asked_at);

/// Tables of the media in use, as written and resolved, each once.
std::vector<std::pair<std::string, std::filesystem::path>> medium_tables(const Case& c);

/// The names of those that are defined, but that neither [target] nor [ground] has.
std::vector<std::string> unused_materials(const Case& c);

/// The names of materials that every case knows.
inline constexpr std::array<const char*, 2> own_materials = {"pec", "absorber"};

}  // namespace raytube
