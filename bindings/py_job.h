// A job as Python holds it.
#pragma once

#include "bindings.h"

#include "render/checkpoint.h"
#include "render/output.h"

#include <memory>
#include <string>

namespace mlt::python {

using LoadedPtr = std::shared_ptr<LoadedScene>;

/// A job and what it was made from.
class PyJob {
 public:
  PyJob(LoadedPtr loaded, MadeIntegrator made, const RenderSettings& settings)
      : loaded_(std::move(loaded)),
        made_(std::move(made)),
        seed_(settings.seed),
        job_(std::make_unique<Job>(loaded_->scene, made_.integrator, settings)) {}
  ~PyJob() {
    py::gil_scoped_release release;
    job_->stop();  // while a crew may still use this object
    job_.reset();
  }

  Job& operator*() { return *job_; }
  const LoadedPtr& loaded() const { return loaded_; }
  Stats stats() const { return render_stats(*job_, *loaded_, made_); }
  Metadata metadata() const { return render_metadata(stats(), *loaded_, made_); }
  void checkpoint(const std::string& path) {
    check_checkpoint_writable(path);
    Checkpoint checkpoint = checkpoint_of(*loaded_, made_, seed_);
    checkpoint.state = job_->save();
    write_checkpoint(path, checkpoint);
  }

 private:
  LoadedPtr loaded_;
  MadeIntegrator made_;
  uint64_t seed_;
  std::unique_ptr<Job> job_;
};

}  // namespace mlt::python
