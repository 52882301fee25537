// Messages to rank 0 of a communicator, given by its Fortran handle.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace raytube {

/// Sends without waiting, from any thread.
class MpiOutbox {
 public:
  explicit MpiOutbox(int communicator);
  ~MpiOutbox();

  /// Throws std::runtime_error for a message larger than MPI can count.
  void send(int tag, std::string bytes);
  /// Returns when all have been sent.
  void flush();

 private:
  struct Messages;
  std::unique_ptr<Messages> messages_;
};

/// Takes messages as they come, in a thread of its own, until it is destroyed.
class MpiInbox {
 public:
  using Take = std::function<void(int tag, std::string bytes)>;
  MpiInbox(int communicator, Take take);
  ~MpiInbox();

 private:
  struct Receiver;
  std::unique_ptr<Receiver> receiver_;
};

}  // namespace raytube
