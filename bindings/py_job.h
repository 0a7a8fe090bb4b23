// A job as a Python object.
#pragma once

#include "bindings.h"

#include "base/file_lock.h"
#include "job/checkpoint.h"
#include "job/output.h"

namespace mlt::python {

/// A job, and the objects that it was made from.
class PyJob : public Job {
 public:
  PyJob(LoadedPtr loaded, const MadeIntegrator& made, const RenderSettings& settings)
      : Job(loaded->scene, made.integrator, settings),
        loaded_(std::move(loaded)),
        made_(made),
        settings_(settings) {}
  ~PyJob() {
    const ReleasedGil release;
    stop();  // while an executor may still use this object
  }

  const LoadedPtr& loaded() const { return loaded_; }
  Stats stats() const { return render_stats(*this, *loaded_, made_); }
  Metadata metadata() const { return render_metadata(stats(), *loaded_, made_, settings_); }
  void checkpoint(const std::string& path, bool overwrite) {
    check_checkpoint_writable(path);
    Checkpoint checkpoint = checkpoint_of(*loaded_, made_, settings_.seed);
    const auto lock = FileLock::of(path);
    if (!overwrite) check_same_render(path, checkpoint);
    checkpoint.state = save();
    write_checkpoint(path, checkpoint);
  }

 private:
  LoadedPtr loaded_;
  MadeIntegrator made_;
  RenderSettings settings_;
};

}  // namespace mlt::python
