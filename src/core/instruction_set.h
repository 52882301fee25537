// Which vector instructions of the processor may be used. Only speed depends on it, never a result.
#pragma once

#include <string>
#include <string_view>

namespace raytube {

/// In order of width. Embree takes any of them; our own code needs avx2 and uses avx512 where it may.
enum class InstructionSet { sse2, sse42, avx, avx2, avx512 };

/// As Embree calls it: "sse4.2".
std::string name_of(InstructionSet set);

/// The widest one this processor has.
InstructionSet widest_instruction_set();

/// The widest one that may be used, at first the widest one there is.
InstructionSet allowed_instruction_set();

/// From now on no wider one than this is used. Throws InputError for an unknown name, and for one this processor lacks. Not while
/// a tracer exists.
void limit_instruction_set(std::string_view name);

}  // namespace raytube
