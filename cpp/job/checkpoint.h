// A render on disk: what was asked for (scene, integrator, seed) and how far it has come.
//
//   "pymlt checkpoint" | size of the body: uint64 | CRC-32 of the body: uint32 | body
//   body: version, build, scene source, scene hash, integrator, seed, state (Job::save)
//
// Numbers are little-endian, as the machine has them. Only the build that wrote a file reads it:
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

/// What a render of these settings puts into its checkpoints, but for the state. Throws UsageError
/// for an integrator that its node does not tell.
Checkpoint checkpoint_of(const LoadedScene& loaded, const MadeIntegrator& made, uint64_t seed);

/// Throws FileError for a file that is missing, foreign, truncated, damaged or of another build.
Checkpoint read_checkpoint(const std::string& path);
/// The same for the bytes of a file; `path` is for messages.
Checkpoint decode_checkpoint(const std::string& file, const std::string& path);

/// Replaces an older one at once or not at all. Throws FileError.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Throws now the FileError that write_checkpoint would end in; also if there is a file that is no
/// checkpoint, so that a slip does not cost a scene or an image.
void check_checkpoint_writable(const std::string& path);

/// Throws FileError if there is the checkpoint of another render, or one that cannot be read.
/// Returns after how many units the checkpoint that is there was taken, or 0.
uint64_t check_same_render(const std::string& path, const Checkpoint& checkpoint);

struct CheckpointFile {
  std::string path;
  double every = 60;       ///< Seconds.
  bool overwrite = false;  ///< Whatever checkpoint is there.
};

/// Writes the states of a render to one file, which no other process may use meanwhile. One that
/// this render has written before is kept until there is a later state. Throws FileError if there
/// is another render's.
AutosaveSettings autosave_to(const CheckpointFile& file, Checkpoint checkpoint);

/// The scene of a checkpoint, from where it was; `moved_to` names another place for its XML file,
/// or is "". Throws UsageError for a scene that only Python can make, SceneError for one that
/// differs.
LoadedScene load_scene(const Checkpoint& checkpoint, const std::string& path,
                       const std::string& moved_to, const Registry& registry);

/// Throws SceneError unless it is the scene of the checkpoint at `path`.
void check_same_scene(const Checkpoint& checkpoint, const std::string& path,
                      const LoadedScene& loaded);

/// Makes a job that was just made go on from there. Throws FileError if the state does not fit it.
void resume(Job& job, const Checkpoint& checkpoint, const std::string& path);

}  // namespace mlt
