// One fuzz target a source file. Under clang libFuzzer calls it with inputs of its own making, under g++ replay.cpp with the
// files of corpus/. A target returns for whatever bytes it gets; what it must not do is crash, hang, or break an expectation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace raytube::fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size) { return {reinterpret_cast<const char*>(data), size}; }

/// Ends the process with a sentence, so that libFuzzer and ctest both count the input as a finding.
[[noreturn]] void broken(const std::string& expectation);

inline void expect(bool holds, const char* expectation) {
  if (!holds) broken(expectation);
}

/// Every message to the user is one sentence of printable bytes with something in it.
void expect_sentence(const std::string& message);

/// What cannot be read is refused in such a sentence.
template <class Read>
void refuse_or(Read read) {
  try {
    read();
  } catch (const InputError& error) {
    expect_sentence(error.what());
  }
}

}  // namespace raytube::fuzz
