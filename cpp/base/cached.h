// A cached value: computed at its first use, and kept until it is invalidated.
#pragma once

#include <utility>

namespace mlt {

template <class T>
class Cached {
 public:
  template <class Find>
  const T& get(Find&& find) {
    if (!known_) value_ = std::forward<Find>(find)();
    known_ = true;
    return value_;
  }
  void set(const T& value) {
    value_ = value;
    known_ = true;
  }
  void invalidate() { known_ = false; }

 private:
  bool known_ = false;
  T value_{};
};

}  // namespace mlt
