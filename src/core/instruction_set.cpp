#include "core/instruction_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.h"

namespace raytube {

namespace {

constexpr std::array names{"sse2", "sse4.2", "avx", "avx2", "avx512"};

InstructionSet& allowed() {
  static InstructionSet set = widest_instruction_set();
  return set;
}

}  // namespace

std::string name_of(InstructionSet set) { return names[static_cast<std::size_t>(set)]; }

// AVX-512 with the parts that Embree asks for; the whole program needs avx2 (x86-64-v3).
InstructionSet widest_instruction_set() {
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512vl");
  return avx512 ? InstructionSet::avx512 : InstructionSet::avx2;
}

InstructionSet allowed_instruction_set() { return allowed(); }

void limit_instruction_set(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw InputError(fmt::format("--instruction-set {}: not known; write one of {}", name, fmt::join(names, ", ")));
  const auto set = static_cast<InstructionSet>(found - names.begin());
  if (set > widest_instruction_set())
    throw InputError(fmt::format("--instruction-set {}: this processor has none wider than {}; leave the option out", name,
                                 name_of(widest_instruction_set())));
  allowed() = set;
}

}  // namespace raytube
