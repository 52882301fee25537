#include "bindings/interruptible.h"

#include <unistd.h>

#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>

namespace raytube::python {

namespace py = pybind11;
using namespace std::chrono_literals;

namespace {

constexpr auto look_out = 20ms;   // for signals
constexpr auto patience = 300ms;  // with work that should end by itself
constexpr auto between_shares = 100ms;

std::mutex counting;
std::condition_variable none_left;
int workers = 0, waiting = 0;  // threads that work, and threads of Python in wait_for()
std::atomic<bool> leaving_now = false;

void count(int& threads, int more) {
  const std::lock_guard lock(counting);
  threads += more;
  none_left.notify_all();
}

// A thread of Python that is here when the interpreter goes would be taken apart in the middle of C++.
class Waiting {
 public:
  Waiting() { count(waiting, 1); }
  ~Waiting() { count(waiting, -1); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
};

class Shares {
 public:
  explicit Shares(const py::object& progress) : progress_(progress) {}

  void tell(double share) {
    const auto now = std::chrono::steady_clock::now();
    if (progress_.is_none() || share == told_ || now - told_at_ < between_shares) return;
    told_ = share;
    told_at_ = now;
    progress_(share);
  }

  void tell_end() {
    if (!progress_.is_none()) progress_(1.0);
  }

 private:
  const py::object& progress_;
  double told_ = 0.0;
  std::chrono::steady_clock::time_point told_at_{};
};

}  // namespace

void Workers::begin(std::function<void()> work) {
  count(workers, 1);
  try {
    std::thread([work = std::move(work)]() mutable {
      work();
      work = nullptr;  // it holds what was worked on
      count(workers, -1);
    }).detach();
  } catch (...) {
    count(workers, -1);
    throw;
  }
}

void Workers::leave() {
  std::unique_lock lock(counting);
  leaving_now = true;
  if (none_left.wait_for(lock, patience, [] { return workers == 0 && waiting == 0; })) return;
  on_exit([](int status, void*) { std::fflush(nullptr), _exit(status); }, nullptr);
}

bool Workers::leaving() { return leaving_now; }

void wait_for(const std::function<bool(std::chrono::milliseconds)>& done_within, Watch& watch, const py::object& progress) {
  const auto ready = [&](std::chrono::milliseconds time) {
    const py::gil_scoped_release others_go_on;
    return done_within(time);
  };
  const Waiting here;
  Shares shares(progress);
  try {
    while (!ready(look_out)) {
      if (Workers::leaving()) PyErr_SetNone(PyExc_KeyboardInterrupt);
      if (PyErr_Occurred() || PyErr_CheckSignals() != 0) throw py::error_already_set();
      shares.tell(watch.share);
    }
  } catch (...) {
    watch.stop = true;
    if (!Workers::leaving()) ready(patience);
    throw;
  }
  shares.tell_end();
}

}  // namespace raytube::python
