// The layers that a render is asked for, and what the headers of files tell about those with ids:
// Cryptomatte Specification, "Metadata".
#pragma once

#include "image/exr.h"
#include "job/job.h"

#include <string>

namespace mlt {

/// Sets the layers of a render: see parse_aovs.
void ask_for_layers(const std::string& list, const LoadedScene& loaded, RenderSettings& settings);

/// The name, hash, conversion and manifest of each Cryptomatte.
Metadata cryptomatte_metadata(const RenderSettings& settings);

/// Whether a layer belongs to a Cryptomatte that these metadata describe: its numbers are bits.
bool has_ids(const std::string& layer, const Metadata& metadata);

}  // namespace mlt
