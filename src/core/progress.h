// Progress of work that many threads share.
#pragma once

#include <functional>
#include <mutex>

#include "core/error.h"

namespace raytube {

/// Shares of finished work from many threads, handed to one callback at a time; a callback that returns false stops the work.
class Progress {
 public:
  /// Without a callback nothing is told and nothing stops.
  explicit Progress(std::function<bool(double)> callback) : callback_(std::move(callback)) {}

  /// Adds a share of the whole (all shares sum to 1). Throws Interrupted once the callback has said stop.
  void add(double share) {
    if (!callback_) return;
    const std::lock_guard lock(mutex_);
    done_ += share;
    if (!stopped_ && !callback_(done_ < 1.0 ? done_ : 1.0)) stopped_ = true;
    if (stopped_) throw Interrupted();
  }

 private:
  std::function<bool(double)> callback_;
  std::mutex mutex_;
  double done_ = 0.0;
  bool stopped_ = false;
};

}  // namespace raytube
