#include "target.h"

#include <cstdio>
#include <cstdlib>

namespace raytube::fuzz {

void broken(const std::string& expectation) {
  std::fprintf(stderr, "broken: %s\n", expectation.c_str());
  std::abort();
}

void expect_sentence(const std::string& message) {
  expect(message.size() > 10, "a message says something");
  expect(message.size() < 4000, "a message can be read");
}

}  // namespace raytube::fuzz
