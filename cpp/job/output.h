// What a render leaves behind: the image files and what they say about how they were made. Both
// command lines and the Python face write through these functions.
#pragma once

#include "image/image_io.h"
#include "io/load.h"
#include "job/job.h"
#include "job/make_integrator.h"

#include <string>

namespace mlt {

/// The size of the image that a render of the scene makes: the film's, or its crop window's.
Vec2i image_size(const Scene& scene);

/// Throws UsageError for a pixel outside of the image.
void check_pixel(const Scene& scene, const Vec2i& pixel);

/// The job's, completed by what loading and the integrator had to say.
Stats render_stats(const Job& job, const LoadedScene& loaded, const MadeIntegrator& made);

/// The version, the scene's hash, the integrator's settings, the seed and the samples per pixel. No
/// date, host or number of threads: equal renders are equal files.
Metadata render_metadata(const Stats& stats, const LoadedScene& loaded, const MadeIntegrator& made);

/// What a render made: its image, and the further ones that it was asked to keep.
struct RenderedImage {
  Image image;
  std::vector<NamedImage> layers;
};

/// Writes the image by extension. EXR files hold the layers too.
void write_render(const std::string& path, const RenderedImage& render,
                  const WriteOptions& options);

/// Where a file is after all.
struct Saved {
  std::string path;     ///< "" if no place would have it.
  std::string problem;  ///< Why it is not where it was asked for, and where it is; "" if it is.
};

/// The same, or, if that fails, in the current or the temporary folder under a name that is not
/// taken. Throws no FileError.
Saved save_render(const std::string& path, const RenderedImage& render,
                  const WriteOptions& options);

/// The same for a text file.
Saved save_text(const std::string& path, const std::string& text);

}  // namespace mlt
