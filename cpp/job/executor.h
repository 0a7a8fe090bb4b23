// Executors run the units of a render: by default threads of this process.
#pragma once

#include "job/task.h"

namespace mlt {

class Job;

/// Runs units; called by the thread that leads the render. An executor that runs them elsewhere
/// does so by the job's tasks; the bootstrap always runs here.
class Executor {
 public:
  virtual ~Executor() = default;
  /// About how many tasks the render is cut into; 0: none.
  virtual int wanted_tasks() { return 0; }
  /// Runs the units before `to`. Returns early when the job is interrupted; it will be called
  /// again.
  virtual void run(Job& job, uint64_t to);
  /// Called when the render has ended; it may be extended later.
  virtual void close() {}
};

}  // namespace mlt
