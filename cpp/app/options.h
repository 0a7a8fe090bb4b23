// What a person can ask of mlt-render.
#pragma once

#include "io/load.h"
#include "render/job.h"
#include "render/make_integrator.h"

#include <string>
#include <vector>

namespace mlt {

struct Options {
  std::string scene;
  std::vector<std::string> outputs;  ///< Image files, by extension.
  std::string stats;                 ///< A JSON file, or "".
  std::string integrator;            ///< "": the scene's own.
  Assignments parameters;
  LoadOptions load;
  RenderSettings render;
  std::string checkpoint;  ///< A file to be renewed while it renders, or "".
  std::string resume;      ///< A file to go on from, or "".
  double every = 60;       ///< Seconds between checkpoints.
  double exposure = 0;
  bool quiet = false;
};

/// Throws UsageError for flags that contradict each other. With `resume` the checkpoint says what is
/// rendered; only budgets, threads, outputs and the scene's place may be given.
void check_options(const Options& options, bool seed_given, bool every_given);

/// "name=value" in two. Throws UsageError.
std::pair<std::string, std::string> parse_assignment(const std::string& flag,
                                                     const std::string& text);
/// "640x360". Throws UsageError.
Vec2i parse_size(const std::string& text);

}  // namespace mlt
