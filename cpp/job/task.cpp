#include "job/task.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "base/watchdog.h"

#include <algorithm>

namespace mlt {
namespace {

using Content = Rendering::Content;

struct Result {
  Task task;  ///< Its `to` is the first unit that is not done.
  uint64_t units;
};

}  // namespace

uint64_t run_units(Rendering& rendering, const Task& task, int threads,
                   const std::function<bool()>& interrupted, std::atomic<uint64_t>& units_done) {
  std::atomic<uint64_t> next{task.from};
  std::atomic<bool> failed{false};
  parallel_for(threads, threads, [&](uint64_t) {
    while (!failed && !interrupted()) {
      const uint64_t unit = next++;
      if (unit >= task.to) break;
      if (!task.strands.has(rendering.plan().strand_of(unit))) continue;
      try {
        rendering.run_unit(unit);
      } catch (...) {
        failed = true;
        throw;
      }
      ++units_done;
    }
  });
  return std::min<uint64_t>(next, task.to);
}

TaskList::TaskList(Rendering& rendering, uint64_t seed, int wanted, uint64_t done)
    : rendering_(&rendering), seed_(seed) {
  for (const Strands& strands : rendering.plan().cut(wanted)) tasks_.push_back({strands, done});
}

uint64_t TaskList::done() const {
  uint64_t least = ~uint64_t{0};
  for (const Task& task : tasks_) least = std::min(least, task.from);
  return least;
}

bool TaskList::split(size_t index) {
  Task& task = tasks_.at(index);
  const uint64_t middle = (task.strands.first + task.strands.last) / 2;
  if (middle == task.strands.first) return false;
  const Task second{{middle, task.strands.last}, task.from};
  task.strands.last = middle;
  tasks_.push_back(second);
  return true;
}

bool TaskList::skip(size_t index, uint64_t to) {
  Task& task = tasks_.at(index);
  for (uint64_t unit = task.from; unit < to; ++unit)
    if (task.strands.has(rendering_->plan().strand_of(unit))) return false;
  task.from = std::max(task.from, to);
  return true;
}

std::string TaskList::task(size_t index, uint64_t to) const {
  Task task = tasks_.at(index);
  task.to = to;
  ByteWriter bytes;
  bytes.write(seed_);
  bytes.write(task);
  bytes.write(rendering_->save(task, Content::task));
  return bytes.take();
}

uint64_t TaskList::merge(size_t index, const std::string& result) {
  Task& task = tasks_.at(index);
  ByteReader bytes(result);
  const auto [done, units] = bytes.read<Result>();
  std::string state;
  bytes.read(state);
  bytes.finish();
  if (done.strands.first != task.strands.first || done.strands.last != task.strands.last ||
      done.from != task.from || done.to < task.from)
    throw RenderError("the result of a task came that was not asked for");
  rendering_->load(state);
  task.from = done.to;
  return units;
}

std::string run(const std::string& bytes, ScenePtr scene, const Integrator& integrator, int threads,
                const std::atomic<bool>& cancelled) {
  ByteReader reader(bytes);
  const auto seed = reader.read<uint64_t>();
  const auto task = reader.read<Task>();
  std::string state;
  reader.read(state);
  reader.finish();
  const std::unique_ptr<Rendering> rendering = integrator.start(std::move(scene), seed);
  rendering->load(state);
  state.clear();

  std::atomic<uint64_t> units{0};
  Result result{task, 0};
  const auto stopping = [&] { return cancelled.load(); };
  try {
    const Watchdog watchdog(stopping);
    result.task.to = run_units(*rendering, task, threads, stopping, units);
  } catch (const Abandoned&) {
    throw RenderError("a light path did not end after the render was to end, and was given up");
  }
  result.units = units;
  ByteWriter writer;
  writer.write(result);
  writer.write(rendering->save(task, Content::result));
  return writer.take();
}

}  // namespace mlt
