#include "app/flags.h"

#include "base/error.h"
#include "base/text.h"
#include "image/image_io.h"
#include "job/job.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>

namespace mlt {
namespace {

namespace fs = std::filesystem;

using Parsed = std::optional<FlagValue>;

constexpr uint64_t highest_int = std::numeric_limits<int>::max();

std::optional<uint64_t> parse_count(std::string_view text, uint64_t highest) {
  uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > highest)
    return std::nullopt;
  return value;
}

Parsed parse_positive(const std::string& text) {
  const auto number = parse_real(text);
  return number && *number > 0 ? Parsed(*number) : std::nullopt;
}

/// A share, or percent. Throws UsageError for a share above 1, which is probably meant as percent.
Parsed parse_share(const std::string& text) {
  const bool percent = !text.empty() && text.back() == '%';
  const auto number = parse_real(percent ? text.substr(0, text.size() - 1) : text);
  if (!number || !(*number > 0)) return std::nullopt;
  const double share = percent ? *number / 100 : *number;
  if (share > 1 && !percent)
    throw UsageError(fmt::format("error is {0:g}, which is {1:g} %; did you mean '{0:g}%'?", share,
                                 100 * share));
  return share > 1 ? std::nullopt : Parsed(share);
}

Parsed parse_spp(const std::string& text) {
  const Parsed number = parse_positive(text);
  return number && std::get<double>(*number) <= max_spp ? number : std::nullopt;
}

Parsed parse_stops(const std::string& text) {
  if (text == "auto") return text;
  const auto number = parse_real(text);
  return number && std::abs(*number) <= max_exposure ? Parsed(*number) : std::nullopt;
}

Parsed parse_size(const std::string& text) {
  const size_t cross = text.find('x');
  if (cross == std::string::npos) return std::nullopt;
  const auto width = parse_count(text.substr(0, cross), highest_int);
  const auto height = parse_count(text.substr(cross + 1), highest_int);
  if (width.value_or(0) == 0 || height.value_or(0) == 0) return std::nullopt;
  return std::pair(static_cast<int>(*width), static_cast<int>(*height));
}

Parsed parse_assignment(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) return std::nullopt;
  return std::pair(text.substr(0, equals), text.substr(equals + 1));
}

const FlagType any_text{"a text", [](const std::string& text) { return Parsed(text); }},
    threads{"an integer from 0 to 4096",
            [](const std::string& text) -> Parsed { return parse_count(text, max_threads); }},
    seed{"an integer from 0 to 18446744073709551615",
         [](const std::string& text) -> Parsed { return parse_count(text, UINT64_MAX); }},
    sensor{"an integer from 0 to 2147483647",
           [](const std::string& text) -> Parsed { return parse_count(text, highest_int); }},
    stops{"a number from -128 to 128, or auto", parse_stops},
    positive{"a positive number", parse_positive},
    share{"a share up to 1 or percent up to 100, such as 0.02 or 2%", parse_share},
    spp{"a positive number up to 2147483647", parse_spp},
    image_size{"WIDTHxHEIGHT in pixels, such as 640x360", parse_size},
    assignment{"NAME=VALUE", parse_assignment};

/// The first spelling of a flag: "-o" of "-o,--output".
std::string first_spelling(const Flag& flag) {
  const std::string all = flag.spelling;
  return all.substr(0, all.find(','));
}

/// See render_flags().
const Flag all_flags[] = {
    {"scene", "scene", "SCENE", &any_text, "Mitsuba XML file, or the name of a built-in scene",
     Flag::file},
    {"output", "-o,--output", "FILE", &any_text,
     "image file: .exr, .png, .jpg or .hdr; may be repeated",
     Flag::required | Flag::repeatable | Flag::file},
    {"integrator", "--integrator", "NAME", &any_text, "algorithm, in place of the scene's own",
     Flag::fixed_by_resume},
    {"parameters", "-p", "NAME=VALUE", &assignment, "integrator parameter; may be repeated",
     Flag::repeatable | Flag::fixed_by_resume},
    {"defines", "-D", "NAME=VALUE", &assignment,
     "value for a <default> parameter of the scene; may be repeated",
     Flag::repeatable | Flag::fixed_by_resume},
    {"size", "--size", "WxH", &image_size, "image size in pixels, such as 640x360",
     Flag::fixed_by_resume},
    {"sensor", "--sensor", "N", &sensor, "which of the scene's sensors, counted from 0",
     Flag::fixed_by_resume},
    {"filter", "--filter", "NAME", &any_text,
     "reconstruction filter, in place of the scene's own: box, tent, gaussian, mitchell, "
     "catmullrom, lanczos",
     Flag::fixed_by_resume},
    {"spectral", "--spectral", "", nullptr,
     "light has wavelengths instead of R, G and B, even if the scene does not ask for it",
     Flag::fixed_by_resume},
    {"lenient", "--lenient", "", nullptr,
     "leave out unknown parameters of the scene with a warning, as in files of Mitsuba 0.x",
     Flag::fixed_by_resume},
    {"strict", "--strict", "", nullptr,
     "refuse unknown parameters of the scene, as in files of Mitsuba 2 and later",
     Flag::fixed_by_resume},
    {"spp", "--spp", "N", &spp, "samples (or mutations) per pixel"},
    {"time", "--time", "SECONDS", &positive, "seconds to render"},
    {"error", "--error", "E", &share, "relative error to reach, such as 2% or 0.02"},
    {"aovs", "--aov", "LIST", &any_text,
     "layers of what the camera sees first: albedo, depth, position, uv, geo_normal, sh_normal, "
     "shape_index, prim_index, optical_depth (of the media before it), cryptomatte_object, "
     "cryptomatte_material; each may have a name, as in n:sh_normal"},
    {"light_groups", "--light-groups", "", nullptr,
     "EXR files have the light of each lamp as a layer, such as light.lamp; they add up to the "
     "image",
     Flag::fixed_by_resume},
    {"light_layers", "--layer", "NAME=CLASS", &assignment,
     "EXR files have the light of a class of paths as a layer: a regular expression over their "
     "letters from the light to the eye, such as caustics=LS+DE; may be repeated",
     Flag::repeatable | Flag::fixed_by_resume},
    {"alpha", "--alpha", "", nullptr, "EXR and PNG files have alpha; see also hide_emitters"},
    {"seed", "--seed", "N", &seed, "seed of all random numbers (0)", Flag::fixed_by_resume},
    {"threads", "--threads", "N", &threads, "0: as many as the machine has"},
    {"checkpoint", "--checkpoint", "FILE", &any_text, "keep the state of the render in this file",
     Flag::file},
    {"every", "--every", "SECONDS", &positive, "between checkpoints (60)", 0, "checkpoint"},
    {"overwrite", "--overwrite", "", nullptr,
     "--checkpoint may replace the checkpoint of another render", 0, "checkpoint"},
    {"resume", "--resume", "FILE", &any_text,
     "go on from a checkpoint, in place of SCENE; it is renewed, unless --checkpoint names "
     "another file",
     Flag::file},
    {"cluster", "--cluster", "ADDRESS", &any_text,
     "render on a dask cluster, such as tcp://host:8786, or on local:N processes",
     Flag::python_only},
    {"stats", "--stats", "FILE", &any_text, "write what the render tells about itself, as JSON",
     Flag::file},
    {"exposure", "--exposure", "STOPS", &stops,
     "brighten PNG files by this number of stops; auto: as suits the image"},
    {"quiet", "--quiet", "", nullptr, "say nothing but errors"}};

}  // namespace

const std::vector<Flag>& render_flags() {
  static const std::vector<Flag> flags(std::begin(all_flags), std::end(all_flags));
  return flags;
}

FlagValue read_flag(const Flag& flag, const std::string& text) {
  if (auto value = flag.type->parse(text)) return *std::move(value);
  throw UsageError(quote(text) + " is not " + flag.type->expected);
}

void check_files(const std::map<std::string, std::vector<std::string>>& given) {
  std::map<fs::path, std::string> seen;
  for (const Flag& flag : render_flags()) {
    const auto texts = given.find(flag.name);
    if (!flag.is(Flag::file) || texts == given.end()) continue;
    for (const std::string& text : texts->second) {
      if (text.empty())
        throw UsageError(first_spelling(flag) + " is empty, but should be the name of a file");
      std::error_code error;
      const fs::path absolute = fs::absolute(text, error);
      if (error) throw UsageError(text + ": the current folder is gone; go to another one");
      const fs::path file = fs::weakly_canonical(absolute, error);
      if (error || (flag.spelling[0] != '-' && !fs::exists(file, error))) continue;
      const auto [other, is_new] = seen.try_emplace(file, first_spelling(flag));
      if (!is_new && !(other->second == "--checkpoint" && first_spelling(flag) == "--resume"))
        throw UsageError(text + ": " + other->second + " and " + first_spelling(flag) +
                         " name the same file");
    }
  }
}

void check_flags(const std::set<std::string>& given) {
  const bool resumed = given.count("resume") > 0;
  if (!resumed && !given.count("scene")) throw UsageError("SCENE is required, or --resume FILE");
  for (const Flag& flag : render_flags()) {
    if (!given.count(flag.name)) continue;
    if (resumed && flag.is(Flag::fixed_by_resume))
      throw UsageError(first_spelling(flag) +
                       " cannot be given with --resume: the checkpoint says it");
    // A resumed render has a checkpoint anyway.
    if (!resumed && *flag.needs && !given.count(flag.needs))
      throw UsageError(first_spelling(flag) + " needs --" + flag.needs);
  }
}

}  // namespace mlt
