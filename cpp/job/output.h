// The output of a render: the image files, and the metadata on how they were made. Both
// command lines and the Python face write through these functions.
#pragma once

#include "image/image_io.h"
#include "io/load.h"
#include "job/job.h"
#include "job/layers.h"
#include "job/make_integrator.h"

#include <string>

namespace mlt {

/// The size of the image that a render of the scene makes: the film's, or its crop window's.
Vec2i image_size(const Scene& scene);

/// Throws UsageError for a pixel outside of the image.
void check_pixel(const Scene& scene, const Vec2i& pixel);

/// The job's statistics, completed by those of loading and the warnings of the integrator.
Stats render_stats(const Job& job, const LoadedScene& loaded, const MadeIntegrator& made);

/// Metadata: version, hash of the scene, settings of the integrator, seed and samples per pixel;
/// the names of the layers of lamps, and what describes Cryptomattes among the layers.
/// No date, host or number of threads: equal renders are equal files.
Metadata render_metadata(const Stats& stats, const LoadedScene& loaded, const MadeIntegrator& made,
                         const RenderSettings& settings);

/// The images of a render: the main one, and the layers that it was asked to keep.
struct RenderedImage {
  Image image;
  std::vector<NamedImage> layers;
};

/// Writes the image by extension. EXR files hold the layers too. A layer "alpha" becomes the alpha
/// of the image in EXR and PNG files; HDR files show it over black.
void write_render(const std::string& path, const RenderedImage& render,
                  const WriteOptions& options);

/// Where a file was saved.
struct Saved {
  std::string path;     ///< Path of the file, or "" if it could not be saved anywhere.
  std::string problem;  ///< Why the file is not where it was asked for, and where it is; or "".
};

/// Writes a render; if that fails, in the current or the temporary folder under a free name.
/// Throws no FileError.
Saved save_render(const std::string& path, const RenderedImage& render,
                  const WriteOptions& options);

/// Writes a text file; if that fails, in another folder, as above.
Saved save_text(const std::string& path, const std::string& text);

}  // namespace mlt
