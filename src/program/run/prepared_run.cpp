#include "program/run/prepared_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "case/target.h"
#include "core/instruction_set.h"
#include "core/threads.h"
#include "jobs/inputs.h"
#include "jobs/shared_work.h"
#include "output/files/sha256.h"
#include "program/helping.h"
#include "program/solve_warnings.h"
#include "scene/sampling.h"

namespace raytube {

namespace {

/// The linker's hash of all that it has put into a file (NT_GNU_BUILD_ID), as digits; empty if there is none. The first object is
/// the program itself.
int take_build_id(dl_phdr_info* object, std::size_t, void* id) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& segment = object->dlpi_phdr[i];
    if (segment.p_type != PT_NOTE) continue;
    const char* note = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
    const std::size_t align = segment.p_align == 8 ? 8 : 4;
    const auto padded = [&](std::size_t size) { return (size + align - 1) / align * align; };
    for (const char* const end = note + segment.p_memsz; note + sizeof(ElfW(Nhdr)) <= end;) {
      ElfW(Nhdr) head;
      std::memcpy(&head, note, sizeof head);
      const char* name = note + sizeof head;
      const char* text = note + padded(sizeof head + head.n_namesz);
      if (text + head.n_descsz > end) break;
      if (head.n_type == NT_GNU_BUILD_ID && std::string_view(name, head.n_namesz) == std::string_view("GNU", 4))
        for (std::size_t b = 0; b < head.n_descsz; ++b)
          static_cast<std::string*>(id)->append(fmt::format("{:02x}", static_cast<unsigned char>(text[b])));
      note += padded(static_cast<std::size_t>(text - note) + head.n_descsz);
    }
  }
  return 1;
}

// Another program may compute other bytes. To hash all of it takes longer than short runs.
std::string identity_of_program() {
  std::string id;
  dl_iterate_phdr(take_build_id, &id);
  return id.empty() ? sha256_of_file("/proc/self/exe") : id;
}

}  // namespace

JournalIdentity identity_of(const Case& c, const Manifest& manifest) {
  JournalIdentity identity{{program_item, manifest.program_version + ' ' + identity_of_program()},
                           {mesh_item, fmt::format("{}", fmt::join(manifest.mesh_sha256, " "))}};
  std::ranges::copy(identity_of_case(c, manifest), std::back_inserter(identity));
  return identity;
}

PreparedRun prepared_run(const RunOptions& asked, const Case& read, const Case& c, const Stopwatch& total) {
  auto [moving, loaded] = load_target_of_plan(c);
  share_work(asked.work, {}, c, loaded.mesh);
  warn_of_reading(c, loaded.report);
  PreparedRun run{c, loaded.report, described_inputs(read, loaded.report, sha256_of_meshes(c, loaded.report)), {}, {}, {}};
  Manifest& manifest = run.manifest;
  manifest.time.read_s = total.seconds();
  manifest.threads = asked.work.threads > 0 ? asked.work.threads : all_threads();
  run_on_threads(manifest.threads, [&] { run.target = std::make_shared<const Target>(std::move(loaded.mesh), c.wedges); });
  manifest.time.build_s = total.seconds() - manifest.time.read_s;
  run.outermost = outermost_points(run.target->mesh.vertices);
  run.planned =
      std::make_unique<const PlannedCase>(run.c, *run.target, run.report, run.outermost, manifest.threads, asked.parts, moving);
  warn_of_materials(c, run.report, *run.target, manifest);
  manifest.embree_instruction_set = name_of(allowed_instruction_set());
  manifest.own_instruction_set = name_of(std::max(allowed_instruction_set(), InstructionSet::avx2));
  return run;
}

}  // namespace raytube
