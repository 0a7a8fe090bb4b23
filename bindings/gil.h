// The interpreter's lock, for threads that may outlive the interpreter. Before 3.14, CPython ends a
// daemon thread that asks for the lock while the interpreter shuts down by pthread_exit, which
// unwinds the stack; where that reaches a destructor the process aborts. Here such a thread sleeps
// until the process has ended, as it does in CPython from 3.14 on.
#pragma once

#include <pybind11/pybind11.h>

#include <cxxabi.h>
#include <unistd.h>

#include <optional>

namespace mlt::python {

/// Calls `take`, which takes the lock; does not return if the interpreter shuts down.
template <class Take>
void take_gil(const Take& take) {
  try {
    take();
  } catch (const abi::__forced_unwind&) {
    for (;;) pause();
  }
}

/// Releases the lock for the rest of the block.
class ReleasedGil {
 public:
  ReleasedGil() : state_(PyEval_SaveThread()) {}
  ~ReleasedGil() {
    take_gil([this] { PyEval_RestoreThread(state_); });
  }
  ReleasedGil(const ReleasedGil&) = delete;
  ReleasedGil& operator=(const ReleasedGil&) = delete;

 private:
  PyThreadState* state_;
};

/// Acquires the lock for the rest of the block, in any thread.
class AcquiredGil {
 public:
  AcquiredGil() {
    take_gil([this] { lock_.emplace(); });
  }
  pybind11::gil_scoped_acquire* operator->() { return &*lock_; }

 private:
  std::optional<pybind11::gil_scoped_acquire> lock_;
};

/// Python's state of a thread of the renderer, kept from its first call to its end: making one
/// costs as much as a short call.
struct ThreadState {
  ThreadState() { AcquiredGil()->inc_ref(); }
  ~ThreadState() { AcquiredGil()->dec_ref(); }
};

/// Acquires the lock in a thread of the renderer. One that Python has started has a state already.
inline AcquiredGil acquire_gil() {
  if (!PyGILState_GetThisThreadState()) thread_local const ThreadState kept;
  return {};
}

}  // namespace mlt::python
