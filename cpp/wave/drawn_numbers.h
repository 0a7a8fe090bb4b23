// The random numbers of many paths side by side, drawn by a Source as soon as a path needs them.
#pragma once

#include "math/lanes.h"

#include <cstddef>

namespace mlt {

class DrawnNumbers {
 public:
  class Source {
   public:
    virtual ~Source() = default;
    /// Draws the numbers of a vertex of these paths, from the first-th on, or only the one of the
    /// leg to it, and sets `numbers` to where those of each path begin.
    virtual void draw(const int* paths, int count, size_t first, bool leg_alone,
                      const double** numbers) = 0;
  };

  void set_source(Source& source) { source_ = &source; }
  void clear() {
    next_ = {};
    count_ = 0;
  }
  void add() {
    path_[count_] = count_;
    ++count_;
  }
  int count() const { return count_; }

  // See WaveNumbers.
  struct Place {
    size_t index = 0;
    Place next() { return {index++}; }
    Place next2() { return {(index += 2) - 2}; }
  };
  Place& places() { return next_; }
  void begin_vertex(const Place& at, int begin, int count, bool leg_alone) {
    source_->draw(&path_[begin], count, at.index, leg_alone, &numbers_[begin]);
  }
  void read(const Place& at, int begin, int count, double* x) const {
    for (int i = 0; i < count; ++i) x[i] = read(at, begin + i);
  }
  void read2(const Place& at, int begin, int count, double* x, double* y) const {
    for (int i = 0; i < count; ++i) {
      x[i] = numbers_[begin + i][at.index];
      y[i] = numbers_[begin + i][at.index + 1];
    }
  }
  double read(const Place& at, int i) const { return numbers_[i][at.index]; }
  void move(int i, int from) { path_[i] = path_[from]; }

 private:
  Source* source_ = nullptr;
  Place next_;
  int count_ = 0;
  Wave<int> path_;
  Wave<const double*> numbers_;
};

}  // namespace mlt
