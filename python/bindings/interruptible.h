// Long work that Ctrl-C stops, while other Python threads go on.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <thread>

namespace raytube::python {

/// Between the work and the thread of Python that waits for it.
struct Watch {
  std::atomic<bool> stop = false;
  std::atomic<double> share = 0.0;

  /// Whether to go on. May be called from any thread.
  bool tell(double done) {
    share = done;
    return !stop;
  }

  /// As solve() wants it.
  std::function<bool(double)> progress() {
    return [this](double done) { return tell(done); };
  }
};

/// Threads that work. One whose work nobody waits for any more goes on until it looks at its flag.
class Workers {
 public:
  /// Does the work on a thread of its own. Throws std::system_error if there is none to be had.
  static void begin(std::function<void()> work);
  /// For the end of the interpreter: those who wait get KeyboardInterrupt. Work that does not stop at once ends with the process,
  /// which from here on takes down none of the libraries that the work uses.
  static void leave();
  static bool leaving();
};

/// Waits without the interpreter's lock. Calls `progress`, if it is no None, with the finished share. Sets watch.stop and throws
/// what Python has raised (KeyboardInterrupt, or an exception of `progress`) at most half a second after it was.
void wait_for(const std::function<bool(std::chrono::milliseconds)>& done_within, Watch& watch, const pybind11::object& progress);

/// The value of work(watch), done on a thread of its own. The work must own all it uses, none of it Python's, for it may outlive
/// this call.
template <class Work>
auto interruptibly(Work work, const pybind11::object& progress = pybind11::none()) {
  using Value = decltype(work(std::declval<Watch&>()));
  const auto watch = std::make_shared<Watch>();
  auto task = std::make_shared<std::packaged_task<Value()>>([work = std::move(work), watch]() mutable { return work(*watch); });
  std::future<Value> value = task->get_future();
  Workers::begin([task = std::move(task)]() mutable {
    (*task)();
    task.reset();
  });
  wait_for([&value](std::chrono::milliseconds time) { return value.wait_for(time) == std::future_status::ready; }, *watch,
           progress);
  return value.get();
}

}  // namespace raytube::python
