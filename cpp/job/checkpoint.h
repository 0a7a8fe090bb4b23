// A render on disk: its settings (scene, integrator, seed) and its state.
//
//   "pymlt checkpoint" | size of the body: uint64 | CRC-32 of the body: uint32 | body
//   body: version, build, scene source, scene hash, integrator, seed, state (Job::save)
//
// Numbers are little-endian, as in memory. Only the build that wrote a file reads it:
// the same pixels are promised within one build, and states have no other description than its
// code.
#pragma once

#include "io/load.h"
#include "job/job.h"
#include "job/make_integrator.h"

#include <string>

namespace mlt {

struct Checkpoint {
  SceneSource scene;
  uint64_t scene_hash = 0;
  Node integrator;
  uint64_t seed = 0;
  std::string state;  ///< See Job::save.
};

/// The checkpoint of a render with these settings, without the state. Throws UsageError for an
/// integrator that its node does not describe.
Checkpoint checkpoint_of(const LoadedScene& loaded, const MadeIntegrator& made, uint64_t seed);

/// Reads a checkpoint. Throws FileError if it is missing, foreign, damaged or of another build.
Checkpoint read_checkpoint(const std::string& path);
/// As above, from the bytes of a file; `path` is for messages.
Checkpoint decode_checkpoint(const std::string& file, const std::string& path);

/// Writes a checkpoint; replaces an older one at once or not at all. Throws FileError.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Throws now the FileError that write_checkpoint would throw later; also if the file exists and is
/// no checkpoint, so that a slip does not overwrite a scene or an image.
void check_checkpoint_writable(const std::string& path);

/// Throws FileError if the file is the checkpoint of another render, or cannot be read.
/// Returns after how many units the existing checkpoint was taken, or 0.
uint64_t check_same_render(const std::string& path, const Checkpoint& checkpoint);

struct CheckpointFile {
  std::string path;
  double every = 60;       ///< Seconds.
  bool overwrite = false;  ///< Replace any checkpoint that is there.
};

/// Writes the states of a render to one file, which no other process may use meanwhile. A
/// checkpoint of the same render is kept until there is a later state. Throws FileError if the file
/// is that of another render.
AutosaveSettings autosave_to(const CheckpointFile& file, Checkpoint checkpoint);

/// Loads the scene of a checkpoint; `moved_to` is the new place of its XML file if it was moved,
/// or "". Throws UsageError for a scene that only Python can make, SceneError for one that
/// differs.
LoadedScene load_scene(const Checkpoint& checkpoint, const std::string& path,
                       const std::string& moved_to, const Registry& registry);

/// Throws SceneError unless it is the scene of the checkpoint at `path`.
void check_same_scene(const Checkpoint& checkpoint, const std::string& path,
                      const LoadedScene& loaded);

/// Loads the state into a new job. Throws FileError if the state does not fit it.
void resume(Job& job, const Checkpoint& checkpoint, const std::string& path);

}  // namespace mlt
