// Who runs the units of a render: by default threads of this process.
#pragma once

#include "job/task.h"

namespace mlt {

class Job;

/// It is called by the thread that leads the render. What runs units elsewhere does so by the job's
/// tasks; the bootstrap is always here.
class Executor {
 public:
  virtual ~Executor() = default;
  /// Into about how many tasks the render is to be cut; 0: into none.
  virtual int wanted_tasks() { return 0; }
  /// Takes the render to the unit `to`. Returns early when the job is interrupted; it will be
  /// called again.
  virtual void run(Job& job, uint64_t to);
  /// The render has ended; it may be extended later.
  virtual void close() {}
};

}  // namespace mlt
