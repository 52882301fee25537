// The real program in a folder of its own: a small good case, and what it says about bad input.
#pragma once

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <algorithm>
#include <string>

#include "scratch.h"

namespace raytube::testing {

const std::string plate = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const std::string target = "[target]\nmesh = \"mesh.off\"\nunit = \"mm\"\n";
const std::string frequency = "[frequency]\nghz = 10\n";
const std::string look = "[look]\ntheta_deg = 10\nphi_deg = 0\n";
const std::string good_case = target + frequency + look;

// Sanitizers take terabytes of addresses for themselves: under them `ulimit -v` stops the program before it begins.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool memory_can_be_limited = false;
#else
constexpr bool memory_can_be_limited = true;
#endif

struct Outcome {
  int code = -1;
  std::string complaint;  // stderr
};

class BadInput : public ::testing::Test {
 protected:
  void SetUp() override {
    scratch.write("mesh.off", plate);
    scratch.write("case.toml", good_case);
  }

  /// Runs the program in the scratch folder with the given words, as a shell would take them.
  Outcome raytube(const std::string& words, const std::string& under = "") const {
    const std::string command =
        "cd '" + scratch.folder().string() + "' && " + under + RAYTUBE_PROGRAM " " + words + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(scratch / "stderr.txt")};
  }

  void expect_refused(const std::string& words, const std::string& says) const {
    const Outcome outcome = raytube(words);
    EXPECT_EQ(outcome.code, 2) << words;
    EXPECT_EQ(std::count(outcome.complaint.begin(), outcome.complaint.end(), '\n'), 1) << outcome.complaint;
    EXPECT_THAT(outcome.complaint, ::testing::AllOf(::testing::HasSubstr(says), ::testing::EndsWith("\n"))) << words;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out")) << words;
  }

  Scratch scratch;
};

}  // namespace raytube::testing
