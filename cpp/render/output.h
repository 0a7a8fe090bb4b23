// What a render leaves behind: the image files and what they say about how they were made. Both
// command lines and the Python face write through these functions.
#pragma once

#include "image/image_io.h"
#include "io/load.h"
#include "render/job.h"
#include "render/make_integrator.h"

#include <string>

namespace mlt {

/// The size of the image that a render of the scene makes: the film's, or its crop window's.
Vec2i image_size(const Scene& scene);

/// The job's, completed by what loading and the integrator had to say.
Stats render_stats(const Job& job, const LoadedScene& loaded, const MadeIntegrator& made);

/// The version, the integrator's settings, the seed and the samples per pixel. No date, host or
/// number of threads: equal renders are equal files.
Metadata render_metadata(const Stats& stats, const MadeIntegrator& made);

/// Writes the image to `path`, or, if that fails, to the current or the temporary folder under a name
/// that is not taken. Returns where it is; throws the first FileError if no place would have it.
std::string save_image(const std::string& path, const Image& image, const WriteOptions& options);

/// The same for a text file.
std::string save_text(const std::string& path, const std::string& text);

}  // namespace mlt
