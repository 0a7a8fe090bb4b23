// The options of a run of mlt-render.
#pragma once

#include "app/flags.h"
#include "io/load.h"
#include "job/checkpoint.h"
#include "job/job.h"
#include "job/make_integrator.h"

#include <optional>
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
  CheckpointFile checkpoint;  ///< Written while it renders; its path may be "".
  std::string resume;         ///< A checkpoint to resume, or "".
  std::string aovs;           ///< Layers, in place of the scene's own.
  LightLayerSettings light;
  std::optional<double> exposure = 0.0;  ///< Stops; nothing: what suits the image.
  bool quiet = false;
};

/// The options by the given flags. Throws UsageError if two flags name one file.
Options read_options(const FlagValues& given);

}  // namespace mlt
