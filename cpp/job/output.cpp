#include "job/output.h"

#include "base/atomic_file.h"
#include "image/alpha.h"
#include "mlt_version.h"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <system_error>

namespace mlt {
namespace {

namespace fs = std::filesystem;

/// A free name such as "folder/rescued-door.exr", or with a number if that exists.
std::string free_name(const fs::path& folder, const fs::path& wanted) {
  std::error_code ignored;
  fs::path name = folder / fmt::format("rescued-{}", wanted.filename().string());
  for (int i = 2; fs::exists(name, ignored) && i < 1000; ++i)
    name = folder /
           fmt::format("rescued-{}-{}{}", wanted.stem().string(), i, wanted.extension().string());
  return name.string();
}

using Write = std::function<void(const std::string& path)>;

/// Writes a file in another folder; returns its path, or "" if no folder can be written.
std::string rescue(const std::string& path, const Write& write) {
  std::error_code no_folder;
  for (const fs::path& folder : {fs::current_path(no_folder), fs::temp_directory_path(no_folder)}) {
    if (folder.empty()) continue;
    try {
      std::string other = free_name(folder, path);
      write(other);
      return other;
    } catch (const FileError&) {
    }
  }
  return "";
}

/// The layer that is the image's alpha, or nullptr; none of an image that has alpha already.
const Image* alpha_of(const RenderedImage& render) {
  if (render.image.channels % 2 == 0) return nullptr;
  for (const auto& [name, image] : render.layers)
    if (name == "alpha" && image.channels == 1 && image.width == render.image.width &&
        image.height == render.image.height)
      return &image;
  return nullptr;
}

Saved save(const std::string& path, const Write& write) {
  try {
    write(path);
    return {path, ""};
  } catch (const FileError& error) {
    const std::string other = rescue(path, write);
    const std::string where = other.empty() ? "no other place would have it" : "it is saved as ";
    return {other, fmt::format("{}; {}{}", error.what(), where, other)};
  }
}

}  // namespace

Vec2i image_size(const Scene& scene) {
  const FilmSettings& film = scene.film();
  return film.crop_size.x > 0 && film.crop_size.y > 0 ? film.crop_size : film.size;
}

void check_pixel(const Scene& scene, const Vec2i& pixel) {
  const Vec2i size = image_size(scene);
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y)
    throw UsageError(fmt::format("pixel ({}, {}) is outside of the image, which has {} x {} pixels",
                                 pixel.x, pixel.y, size.x, size.y));
}

Stats render_stats(const Job& job, const LoadedScene& loaded, const MadeIntegrator& made) {
  Stats stats = job.stats();
  stats.seconds_load = loaded.seconds;
  stats.warnings.insert(stats.warnings.begin(), made.warnings.begin(), made.warnings.end());
  stats.warnings.insert(stats.warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());
  return stats;
}

Metadata render_metadata(const Stats& stats, const LoadedScene& loaded, const MadeIntegrator& made,
                         const RenderSettings& settings) {
  Metadata all = {{"software", "pymlt " MLT_VERSION},
                  {"scene", fmt::format("{:016x}", loaded.hash)},
                  {"integrator", made.settings.text()},
                  {"seed", fmt::format("{}", stats.seed)},
                  {"spp", fmt::format("{}", stats.spp_done)}};
  if (!stats.light_groups.empty())
    all.emplace_back("light_groups", fmt::format("{}", fmt::join(stats.light_groups, " ")));
  for (auto& text : cryptomatte_metadata(settings)) all.push_back(std::move(text));
  return all;
}

void write_render(const std::string& path, const RenderedImage& render,
                  const WriteOptions& options) {
  const Image* const alpha = alpha_problem(path).empty() ? alpha_of(render) : nullptr;
  Image whole;
  if (alpha) whole = with_alpha(render.image, *alpha);
  if (alpha && has_straight_alpha(path)) whole = straight(std::move(whole));
  std::vector<ExrLayer> layers = {{"", alpha ? whole : render.image}};
  for (const NamedImage& layer : render.layers)
    if (&layer.image != alpha)
      layers.push_back({layer.name, layer.image, {}, has_ids(layer.name, options.metadata)});
  write_image(path, layers, options);
}

Saved save_render(const std::string& path, const RenderedImage& render,
                  const WriteOptions& options) {
  return save(path, [&](const std::string& where) { write_render(where, render, options); });
}

Saved save_text(const std::string& path, const std::string& text) {
  return save(path, [&](const std::string& where) { write_file(where, text); });
}

}  // namespace mlt
