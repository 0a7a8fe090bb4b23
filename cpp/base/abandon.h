// Abandoning work from inside. Work that is told to stop finishes its current sample or mutation,
// and one of these may take for ever: a light path between white walls that nothing ends. Code that
// traces rays therefore checks now and then whether the work was abandoned.
#pragma once

#include <atomic>

namespace mlt {

/// Thrown out of work that was abandoned.
struct Abandoned {};

/// While this object lives, work of this thread, and of the loops that it runs in parallel, throws
/// Abandoned once the flag is set.
class Abandonable {
 public:
  explicit Abandonable(const std::atomic<bool>* flag);
  ~Abandonable();
  Abandonable(const Abandonable&) = delete;
  Abandonable& operator=(const Abandonable&) = delete;

  /// The flag of this thread; nullptr: none.
  static const std::atomic<bool>* current();

 private:
  const std::atomic<bool>* outer_;
};

/// Throws Abandoned if this thread's work was abandoned.
void check_abandoned();

}  // namespace mlt
