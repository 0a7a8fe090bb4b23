#include "job/autosave.h"

#include "base/error.h"

namespace mlt {
namespace {
constexpr double longest = 1e9;  // seconds; the clock counts to 292 years

/// The reason why `save` failed, or "".
std::string failure_of(const std::function<void()>& save) {
  try {
    save();
  } catch (const std::bad_alloc&) {
    return "out of memory";
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

Autosave::Autosave(AutosaveSettings settings) : settings_(std::move(settings)) {
  if (!(settings_.every > 0 && settings_.every <= longest))
    throw UsageError("every must be a positive number of seconds, at most 1e9");
}

void Autosave::begin_saved(uint64_t units) {
  units_saved_ = units;
  postpone();
}

void Autosave::postpone() {
  next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                             std::chrono::duration<double>(settings_.every));
}

void Autosave::save(uint64_t units, const State& state) {
  postpone();
  const bool still_writing =
      writer_.valid() && writer_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  if (still_writing || units_saved_ == units) return;
  units_saved_ = units;
  // Only the writer records its failure: it may have ended before this thread goes on.
  const std::string failure = failure_of([&] {
    writer_ = std::async(std::launch::async, [this, bytes = state()]() mutable {
      note(failure_of([&] { settings_.write(std::move(bytes)); }));
    });
  });
  if (!failure.empty()) note(failure);
}

void Autosave::finish(uint64_t units, const State& state) {
  if (!settings_.write) return;
  if (writer_.valid()) writer_.wait();
  if (units_saved_ != units || !failure().empty())
    note(failure_of([&] { settings_.write(state()); }));
  units_saved_ = units;
}

std::string Autosave::failure() const {
  const std::lock_guard lock(mutex_);
  return failure_;
}

void Autosave::note(const std::string& failure) {
  const std::lock_guard lock(mutex_);
  failure_ = failure;
}

}  // namespace mlt
