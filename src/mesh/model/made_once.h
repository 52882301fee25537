// What a struct makes of its other members when it is first asked for.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

namespace raytube {

/// A value that is made once, by whichever thread asks first. A copy makes its own again, as the struct that holds it may be
/// changed then; one that is moved keeps the value where it is.
template <class Value>
class MadeOnce {
 public:
  MadeOnce() = default;
  /// Not made yet.
  MadeOnce(const MadeOnce& /*other*/) : MadeOnce() {}
  /// Takes the value over.
  MadeOnce(MadeOnce&& other) noexcept : made_(std::exchange(other.made_, std::make_unique<Made>())) {}
  /// As copied or moved.
  MadeOnce& operator=(MadeOnce other) noexcept {
    std::swap(made_, other.made_);
    return *this;
  }

  /// The value, which `make` returns if there is none yet. Thread-safe.
  template <class Make>
  const Value& get(const Make& make) const {
    if (const Value* done = made_->done.load(std::memory_order_acquire)) return *done;
    std::call_once(made_->once, [&] { made_->done.store(&made_->value.emplace(make()), std::memory_order_release); });
    return *made_->value;
  }

 private:
  struct Made {
    std::once_flag once;
    std::optional<Value> value;
    std::atomic<const Value*> done = nullptr;
  };
  std::unique_ptr<Made> made_ = std::make_unique<Made>();
};

}  // namespace raytube
