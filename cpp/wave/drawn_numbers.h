// The random numbers of many paths side by side, drawn by a Source as soon as a path needs them.
#pragma once

#include "wave/lanes.h"

#include <cstddef>

namespace mlt {

class DrawnNumbers {
 public:
  /// How many numbers a vertex takes (VertexNumbers).
  static constexpr size_t of_vertex = 7;

  class Source {
   public:
    virtual ~Source() = default;
    /// Draws the numbers of a vertex of these paths, from the first-th on, and sets `numbers` to
    /// where those of each path begin.
    virtual void draw(const int* paths, int count, size_t first, const double** numbers) = 0;
  };

  void set_source(Source& source) { source_ = &source; }
  void clear() { at_ = count_ = 0; }
  void add() {
    path_[count_] = count_;
    ++count_;
  }
  int count() const { return count_; }

  /// The position of the next numbers, for all paths.
  size_t position() const { return at_; }
  void set_position(size_t at) { at_ = at; }
  void begin_vertex(int begin, int count) {
    source_->draw(&path_[begin], count, at_, &numbers_[begin]);
  }

  /// See WaveNumbers::next2.
  void next2(int begin, int count, double* x, double* y) {
    for (int i = 0; i < count; ++i) {
      x[i] = numbers_[begin + i][at_];
      y[i] = numbers_[begin + i][at_ + 1];
    }
    at_ += 2;
  }
  void skip(size_t numbers) { at_ += numbers; }
  void skip2() { skip(2); }
  double peek(int i, size_t ahead) const { return numbers_[i][at_ + ahead]; }
  void move(int i, int from) { path_[i] = path_[from]; }

 private:
  Source* source_ = nullptr;
  size_t at_ = 0;
  int count_ = 0;
  Wave<int> path_;
  Wave<const double*> numbers_;
};

}  // namespace mlt
