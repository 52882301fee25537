// The table of bad input: a row is a folder with files in it and the words of an invocation. Whatever it holds, the program ends
// with exit code 2 and one sentence that names the place and the remedy, and leaves the folder as it was.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scratch.h"

namespace raytube::testing {

struct BadRow {
  std::string name;   // of the test
  std::string words;  // of the command line, as a shell would take them; the program runs in the folder
  std::string says;   // part of the sentence
  std::function<void(const Scratch&)> prepare = [](const Scratch&) {};  // beside case.toml, mesh.off, a.csv and b.csv
  std::string place = {};                                               // another part: the file
  std::string before = {};                                              // what the shell does first
};

/// A row about one file: its name and its bytes.
BadRow with_file(std::string name, const std::string& file, const std::string& bytes, std::string words, std::string says);

inline std::ostream& operator<<(std::ostream& out, const BadRow& row) { return out << row.words.substr(0, 200); }

class BadTable : public ::testing::TestWithParam<BadRow> {};

inline std::string row_name(const ::testing::TestParamInfo<BadRow>& info) { return info.param.name; }

/// Numbers as a file of this machine has them.
template <class... Numbers>
std::string bytes_of(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

}  // namespace raytube::testing
