// A render on several machines. The owner keeps the whole state; for some strands it writes a task,
// "units from ... to, and this is where the strands stand", which any machine with the same scene,
// integrator and seed can run, any number of times with the same result. A result is merged once.
// The pixels have the same bits as if one machine had run all units.
#pragma once

#include "rendering/integrator.h"

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace mlt {

/// Runs the units of a task in their order on `threads` threads, until `interrupted()`. Every unit
/// that was begun is finished. Returns the unit before which all those of the task are done.
uint64_t run_units(Rendering& rendering, const Task& task, int threads,
                   const std::function<bool()>& interrupted, std::atomic<uint64_t>& units_done);

/// The owner's side: the strands of a render, cut into sequences that have one task each. Not for
/// several threads at once.
class TaskList {
 public:
  /// `rendering` has been prepared, and its units 0 ... `done` - 1 have run; it outlives this.
  TaskList(Rendering& rendering, uint64_t seed, int wanted, uint64_t done);

  size_t size() const { return tasks_.size(); }
  /// The unit before which the task's strands are done.
  uint64_t position(size_t index) const { return tasks_.at(index).from; }
  /// The units before this one are done, perhaps with some others.
  uint64_t done() const;
  /// Cuts a task's strands in two, for more machines; false if it has but one strand. The second
  /// half becomes the last task.
  bool split(size_t index);
  /// Moves the task on to the unit `to` if its strands have nothing to do until there.
  bool skip(size_t index, uint64_t to);
  /// Writes the task, up to the unit `to`, as bytes for `run`.
  std::string task(size_t index, uint64_t to) const;
  /// Merges the result of `run` for this task, and moves it on; returns how many units were run.
  /// Throws RenderError if the result does not begin where the task is: nothing counts twice.
  uint64_t merge(size_t index, const std::string& result);

 private:
  Rendering* rendering_;
  uint64_t seed_;
  std::vector<Task> tasks_;  ///< The open-ended tasks.
};

/// The worker's side: runs a task on `threads` threads and returns its result. When `cancelled`
/// becomes true it stops early, and the result records the units that are done.
std::string run(const std::string& task, ScenePtr scene, const Integrator& integrator, int threads,
                const std::atomic<bool>& cancelled);

}  // namespace mlt
