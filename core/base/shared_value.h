// SPDX-License-Identifier: Apache-2.0
// A large value that is copied often and altered rarely, such as the readings of a campaign: copies share it, so that a
// copy costs the same however large it is. Whoever alters it gets one of its own first (copy on write).
#pragma once

#include <memory>
#include <optional>
#include <utility>

namespace spindrift {

/// As std::optional<T>, whose value is read only; `edit` alters it. Different objects may be used by different threads,
/// even where they share a value.
template <class T>
class SharedValue {
 public:
  SharedValue() = default;
  SharedValue(std::nullopt_t /*none*/) {}
  SharedValue(T value) : value_(std::make_shared<T>(std::move(value))) {}
  SharedValue(std::optional<T> value) {
    if (value) value_ = std::make_shared<T>(std::move(*value));
  }

  [[nodiscard]] bool has_value() const noexcept { return value_ != nullptr; }
  explicit operator bool() const noexcept { return has_value(); }
  [[nodiscard]] const T& operator*() const noexcept { return *value_; }
  [[nodiscard]] const T* operator->() const noexcept { return value_.get(); }
  /// Null if there is none.
  [[nodiscard]] const T* get() const noexcept { return value_.get(); }
  /// The same value for as long as it is held, whatever becomes of this object.
  [[nodiscard]] std::shared_ptr<const T> shared() const noexcept { return value_; }
  /// A copy.
  operator std::optional<T>() const { return value_ ? std::optional<T>(*value_) : std::nullopt; }

  /// The value, to be altered here and nowhere else: copied first where it is shared. There must be one.
  [[nodiscard]] T& edit() {
    if (value_.use_count() > 1) value_ = std::make_shared<T>(*value_);
    return *value_;
  }
  T& emplace(T value = {}) { return *(value_ = std::make_shared<T>(std::move(value))); }
  void reset() noexcept { value_.reset(); }

 private:
  std::shared_ptr<T> value_;
};

}  // namespace spindrift
