// A number at rank 0 of a communicator, given by its Fortran handle, that every rank can add to.
#pragma once

#include <cstddef>
#include <memory>

namespace raytube {

/// Made and freed by all ranks together. One that is destroyed without is left to the end of the process, as after an error.
class MpiCounter {
 public:
  explicit MpiCounter(int communicator);
  ~MpiCounter();

  void free();

  /// While nobody adds to it: of rank 0.
  void reset();

  /// The number before.
  std::size_t add(std::size_t count);

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

}  // namespace raytube
