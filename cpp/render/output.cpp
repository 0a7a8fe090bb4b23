#include "render/output.h"

#include "image/atomic_file.h"
#include "mlt_version.h"

#include <fmt/format.h>

#include <filesystem>
#include <functional>

namespace mlt {
namespace {

namespace fs = std::filesystem;

/// "folder/rescued-door.exr", or with a number if that exists.
std::string free_name(const fs::path& folder, const fs::path& wanted) {
  std::error_code ignored;
  fs::path name = folder / fmt::format("rescued-{}", wanted.filename().string());
  for (int i = 2; fs::exists(name, ignored) && i < 1000; ++i)
    name = folder /
           fmt::format("rescued-{}-{}{}", wanted.stem().string(), i, wanted.extension().string());
  return name.string();
}

std::string save(const std::string& path, const std::function<void(const std::string&)>& write) {
  try {
    write(path);
    return path;
  } catch (const FileError&) {
    std::error_code no_folder;
    for (const fs::path& folder :
         {fs::current_path(no_folder), fs::temp_directory_path(no_folder)}) {
      if (folder.empty()) continue;
      try {
        const std::string other = free_name(folder, path);
        write(other);
        return other;
      } catch (const FileError&) {
      }
    }
    throw;
  }
}

}  // namespace

Vec2i image_size(const Scene& scene) {
  const FilmSettings& film = scene.film();
  return film.crop_size.x > 0 && film.crop_size.y > 0 ? film.crop_size : film.size;
}

Stats render_stats(const Job& job, const LoadedScene& loaded, const MadeIntegrator& made) {
  Stats stats = job.stats();
  stats.seconds_load = loaded.seconds;
  stats.warnings.insert(stats.warnings.begin(), made.warnings.begin(), made.warnings.end());
  stats.warnings.insert(stats.warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());
  return stats;
}

Metadata render_metadata(const Stats& stats, const MadeIntegrator& made) {
  return {{"software", "pymlt " MLT_VERSION},
          {"integrator", made.settings},
          {"seed", fmt::format("{}", stats.seed)},
          {"spp", fmt::format("{}", stats.spp_done)}};
}

std::string save_image(const std::string& path, const Image& image, const WriteOptions& options) {
  return save(path, [&](const std::string& where) { write_image(where, image, options); });
}

std::string save_text(const std::string& path, const std::string& text) {
  return save(path, [&](const std::string& where) { write_file(where, text); });
}

}  // namespace mlt
