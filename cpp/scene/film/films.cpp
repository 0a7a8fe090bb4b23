// The settings of a scene's image. Every image is linear RGB; hdrfilm and ldrfilm are the same
// here.
#include "base/registry.h"
#include "base/text.h"
#include "math/colorimetry.h"
#include "scene/film/film_settings.h"

namespace mlt {
namespace {

int read_side(Params& params, const std::string& name, int64_t most) {
  return static_cast<int>(params.integer_in(name, 1, most));
}

void read_size(Params& params, FilmSettings& film) {
  film.size = {read_side(params, "width", film.max_side),
               read_side(params, "height", film.max_side)};
  if (int64_t{film.size.x} * film.size.y > film.max_pixels)
    params.fail(fmt::format("is {} x {} pixels large; at most 2^28 pixels are possible",
                            film.size.x, film.size.y));
}

void read_crop(Params& params, FilmSettings& film) {
  const char* names[] = {"crop_offset_x", "crop_offset_y", "crop_width", "crop_height"};
  if (std::none_of(std::begin(names), std::end(names), [&](auto name) { return params.has(name); }))
    return;
  film.crop_offset = {static_cast<int>(params.integer_in("crop_offset_x", 0, film.size.x - 1)),
                      static_cast<int>(params.integer_in("crop_offset_y", 0, film.size.y - 1))};
  film.crop_size = film.size;
  if (params.has("crop_width")) film.crop_size.x = read_side(params, "crop_width", film.size.x);
  if (params.has("crop_height")) film.crop_size.y = read_side(params, "crop_height", film.size.y);
  const Vec2i end = film.crop_offset + film.crop_size;
  if (end.x > film.size.x || end.y > film.size.y)
    params.fail(fmt::format(
        "has a crop window that ends at ({}, {}), outside of the image of {} x {} pixels", end.x,
        end.y, film.size.x, film.size.y));
}

void read_format(Params& params, FilmSettings& film) {
  const std::string component = params.text("component_format");
  film.half_precision = component == "float16";
  if (component == "uint32") params.warn("component_format 'uint32' is read as 'float32'");
  const std::string format = params.text("pixel_format");
  film.alpha = format == "rgba" || format == "xyza" || format == "luminance_alpha";
  const char* const made = film.alpha ? "rgba" : "rgb";
  if (format != made)
    params.warn(fmt::format("pixel_format {} is read as '{}'", quote(format), made));
  if (params.has("file_format")) params.text("file_format");  // the output's extension decides
}

/// A band as in "400:430".
std::optional<Band> parse_band(const std::string& text) {
  const size_t colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const auto first = parse_real(text.substr(0, colon));
  const auto last = parse_real(text.substr(colon + 1));
  if (!first || !last) return std::nullopt;
  if (*first < first_wavelength || *last > last_wavelength || *first >= *last) return std::nullopt;
  return Band{*first, *last};
}

void read_wavelengths(Params& params, FilmSettings& film) {
  film.spectral = params.boolean("spectral");
  if (!params.has("band")) return;
  if (!film.spectral) params.fail("band", "needs spectral = true");
  const std::string text = params.text("band");
  film.band = parse_band(text);
  if (!film.band)
    params.fail("band", fmt::format("is {}, but should be two wavelengths from {} to {} nm, the "
                                    "lower one first, as in 400:430",
                                    quote(text), first_wavelength, last_wavelength));
}

ObjectPtr create_film(Params& params) {
  auto film = std::make_shared<FilmSettings>();
  read_size(params, *film);
  read_crop(params, *film);
  read_format(params, *film);
  const auto filter = params.object<FilterObject>("rfilter");
  read_wavelengths(params, *film);
  film->filter = filter ? filter->filter : std::make_shared<const Filter>(gaussian_filter());
  return film;
}

std::vector<Parameter> parameters() {
  return {
      {"width", ParamType::integer, int64_t{768}, "Width of the whole image in pixels."},
      {"height", ParamType::integer, int64_t{576}, "Height of the whole image in pixels."},
      {"crop_offset_x", ParamType::integer, int64_t{0}, "Left border of the crop window."},
      {"crop_offset_y", ParamType::integer, int64_t{0}, "Upper border of the crop window."},
      {"crop_width", ParamType::integer, no_default, "Width of the crop window; all if not given."},
      {"crop_height", ParamType::integer, no_default,
       "Height of the crop window; all if not given."},
      {"spectral", ParamType::boolean, false,
       "Whether light has wavelengths instead of R, G and B; the image is RGB all the same."},
      {"band", ParamType::text, no_default,
       "Wavelengths in nm, as in 400:430, of which the image is to show the mean radiance, as a "
       "grey; needs spectral."},
      {"rfilter", ParamType::object, no_default, "Reconstruction filter; gaussian if not given."},
      choice_parameter("component_format", "float16", "Precision of EXR files: half or single.",
                       {"float16", "float32", "uint32"}),
      {"pixel_format", ParamType::text, std::string("rgb"),
       "rgb, or rgba for images with alpha; others are read as one of these, with a warning."},
      {"file_format", ParamType::text, std::string("openexr"),
       "The extension of the output file decides instead."}};
}

Plugin film(const std::string& name, const std::string& doc) {
  std::vector<std::string> ignored = {
      "banner",        "gamma",    "filename",       "label", "attach_log", "high_quality_edges",
      "sample_border", "exposure", "tonemap_method", "key",   "burn",       "compensate",
      "has_alpha"};
  return {{"film", name, doc, parameters(), std::move(ignored)}, create_film};
}

}  // namespace

Plugin film_hdrfilm() { return film("hdrfilm", "Size, crop window and filter of the image."); }
Plugin film_ldrfilm() { return film("ldrfilm", "The same as hdrfilm; tone mapping is ignored."); }

}  // namespace mlt
