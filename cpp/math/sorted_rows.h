// Rows of sorted numbers that can be searched. Above every row there is a tree without pointers:
// one cache line of its numbers, a line with the first of each of those lines, and so on. So a
// search reads one line for each level, where a binary search waits for memory at almost every
// step, and it does not branch.
#pragma once

#include "base/shared_array.h"

#include <algorithm>
#include <experimental/simd>
#include <vector>

namespace mlt {

template <class T>
class SortedRows {
 public:
  SortedRows() = default;
  /// `numbers` are rows of `width` that never fall; `end` is above all numbers to be searched.
  SortedRows(std::vector<T> numbers, size_t width, T end) : width_(width), end_(end) {
    all_ = Level(numbers, width, end);
    for (const Level* below = &all_; width > per_line; below = &above_.back()) {
      width = below->lines_per_row;
      numbers.clear();
      for (const Line& line : below->lines) numbers.push_back(line.numbers[0]);
      above_.emplace_back(numbers, width, end);
    }
    std::reverse(above_.begin(), above_.end());
  }

  /// The i-th number of a row; `end` for i = width.
  T at(size_t row, size_t i) const {
    return i == width_ ? end_ : all_.row(row)[i / per_line].numbers[i % per_line];
  }
  /// The last i with at(row, i) <= x, which holds for i = 0.
  size_t last_up_to(size_t row, T x) const {
    size_t i = 0;
    for (const Level& level : above_) i = i * per_line + level.row(row)[i].last_up_to(x);
    return i * per_line + all_.row(row)[i].last_up_to(x);
  }
  /// Searches for many numbers, each in a row of its own. All of them go down the tree together:
  /// while the line of one is being loaded, the others are compared.
  void last_up_to(const size_t* row, const T* x, int count, size_t* found) const {
    std::fill_n(found, count, 0);
    for (size_t l = 0; l < above_.size(); ++l) {
      const Level& below = l + 1 < above_.size() ? above_[l + 1] : all_;
      for (int i = 0; i < count; ++i) {
        found[i] = found[i] * per_line + above_[l].row(row[i])[found[i]].last_up_to(x[i]);
        __builtin_prefetch(&below.row(row[i])[found[i]]);
      }
    }
    for (int i = 0; i < count; ++i)
      found[i] = found[i] * per_line + all_.row(row[i])[found[i]].last_up_to(x[i]);
  }

 private:
  static constexpr size_t per_line = 64 / sizeof(T);
  struct alignas(64) Line {
    T numbers[per_line];

    size_t last_up_to(T x) const {
      using Lanes = std::experimental::native_simd<T>;
      size_t count = 0;
      for (size_t i = 0; i < per_line; i += Lanes::size())
        count += popcount(Lanes(numbers + i, std::experimental::vector_aligned) <= x);
      return count - 1;
    }
  };
  struct Level {
    Level() = default;
    /// The rows, filled up with `end` to whole lines.
    Level(const std::vector<T>& numbers, size_t width, T end)
        : lines_per_row((width + per_line - 1) / per_line) {
      std::vector<Line> filled(numbers.size() / width * lines_per_row);
      for (size_t row = 0, next = 0; next < numbers.size(); ++row)
        for (size_t i = 0; i < lines_per_row * per_line; ++i)
          filled[row * lines_per_row + i / per_line].numbers[i % per_line] =
              i < width ? numbers[next++] : end;
      lines = std::move(filled);
    }
    const Line* row(size_t row) const { return lines.data() + row * lines_per_row; }

    size_t lines_per_row = 0;
    SharedArray<Line> lines;
  };

  size_t width_ = 0;
  T end_{};
  Level all_;
  std::vector<Level> above_;  ///< Levels of the tree, from the top.
};

}  // namespace mlt
