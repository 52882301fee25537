// A number at rank 0 of a communicator, given by its Fortran handle, that every rank can add to.
#pragma once

#include <cstddef>
#include <memory>

namespace raytube {

/// Made and destroyed by all ranks together.
class MpiCounter {
 public:
  explicit MpiCounter(int communicator);
  ~MpiCounter();

  /// While nobody adds to it: of rank 0.
  void reset();

  /// The number before.
  std::size_t add(std::size_t count);

 private:
  struct Window;
  std::unique_ptr<Window> window_;
};

}  // namespace raytube
