// An array that never changes again: copies of it share the elements.
#pragma once

#include "base/huge_pages.h"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace mlt {

template <class T>
class SharedArray {
 public:
  SharedArray() = default;
  SharedArray(std::vector<T> elements)
      : owner_(std::make_shared<const std::vector<T>>(std::move(elements))),
        data_(owner_->data()),
        size_(owner_->size()) {
    prefer_huge_pages(data_, size_ * sizeof(T));
  }

  const T* data() const { return data_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T& operator[](size_t i) const { return data_[i]; }

 private:
  std::shared_ptr<const std::vector<T>> owner_;
  const T* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace mlt
