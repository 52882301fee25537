// What a run is made of, by its case and by its run.json, and whether the ranks of a job were given the same work.
#pragma once

#include <string>
#include <vector>

#include "case/data/case.h"
#include "core/ordered_json.h"
#include "output/files/journal.h"
#include "output/files/manifest.h"
#include "ranks/ranks.h"

namespace raytube {

/// The settings that a run had, those of --set among them, as overrides of its case file.
std::vector<std::string> settings_of_run(const Json& run);

/// SHA-256 of its mesh files; empty if it says none.
std::vector<std::string> mesh_sha256_of_run(const Json& run);

/// The name of the meshes' item, with their hashes between blanks.
inline constexpr const char* mesh_item = "mesh in target.mesh";

/// What every bit of a look depends on beside the program and the mesh: the keys of the case, and the tables that it names, as
/// `manifest` has them.
JournalIdentity identity_of_case(const Case& c, const Manifest& manifest);

/// The same of a finished run, by its run.json, and of the meshes.
JournalIdentity identity_of_run(const Json& run);

/// The same of a case whose looks may have come from elsewhere than its file, and of what the command was asked for beside it.
JournalIdentity shared_work(const Case& c, const JournalIdentity& asked);

/// Throws InputError if a rank was given other work than rank 0.
void require_same_work(const JournalIdentity& of_leader, const JournalIdentity& own);

/// An identity as one text, and back.
std::string text_of_work(const JournalIdentity& work);
JournalIdentity work_of_text(std::string_view text);

}  // namespace raytube
