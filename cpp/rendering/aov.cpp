#include "rendering/aov.h"

#include "base/text.h"
#include "path/samplers.h"
#include "path/walk.h"
#include "rendering/cryptomatte.h"

#include <fmt/format.h>

#include <set>

namespace mlt {
namespace {

struct KindName {
  const char* name;
  AovKind kind;
};
constexpr KindName kinds[] = {{"albedo", AovKind::albedo},
                              {"depth", AovKind::depth},
                              {"position", AovKind::position},
                              {"uv", AovKind::uv},
                              {"geo_normal", AovKind::geo_normal},
                              {"sh_normal", AovKind::sh_normal},
                              {"shape_index", AovKind::shape_index},
                              {"prim_index", AovKind::prim_index},
                              {"optical_depth", AovKind::optical_depth},
                              {"cryptomatte_object", AovKind::cryptomatte_object},
                              {"cryptomatte_material", AovKind::cryptomatte_material}};

AovKind kind_of(const std::string& name) {
  std::vector<std::string> names;
  for (const KindName& known : kinds) {
    if (name == known.name) return known.kind;
    names.emplace_back(known.name);
  }
  throw UsageError(fmt::format("'{}' is not a layer that can be rendered; there are {}{}", name,
                               fmt::join(names, ", "), suggestion(name, names)));
}

bool is_index(AovKind kind) { return kind == AovKind::shape_index || kind == AovKind::prim_index; }
int channels(AovKind kind) { return kind == AovKind::depth || is_index(kind) ? 1 : 3; }

/// Where a ray leaves what can be passed.
struct FirstSurface {
  bool hit;  ///< Else the ray leaves the scene.
  SurfacePoint at;
  Color optical_depth{0};
};

/// Follows a ray through all media, and with u_leg through surfaces as a walk does.
FirstSurface first_surface(const Scene& scene, Ray ray, double u_leg) {
  FirstSurface first;
  for (;;) {
    first.hit = scene.intersect(ray, first.at);
    if (ray.medium != no_medium) {
      const double distance = first.hit ? distance_to(first.at.p, ray) : ray.t_max;
      first.optical_depth += scene.media()[ray.medium].fly(ray, {distance}).depth.rgb();
    }
    if (!first.hit) return first;
    const double passes = scene.passage(first.at, ray.d).probability;
    if (!(u_leg < passes)) return first;
    u_leg /= passes;
    ray = scene.beyond(ray, first.at);
  }
}

Vec3 value(AovKind kind, const Scene& scene, const Ray& ray, const FirstSurface& first) {
  if (!first.hit && kind != AovKind::optical_depth) return Vec3(is_index(kind) ? -1 : 0);
  const SurfacePoint& at = first.at;
  switch (kind) {
    case AovKind::albedo: return scene.bsdf(at).albedo(at).rgb();
    case AovKind::depth: return Vec3(length(at.p - ray.o), 0, 0);
    case AovKind::position: return at.p + scene.origin();
    case AovKind::uv: return {at.uv, 0};
    case AovKind::geo_normal: return at.ng;
    case AovKind::sh_normal: return at.shading.n;
    case AovKind::shape_index:
      return Vec3(at.instance == SurfacePoint::no_shape ? at.shape : at.instance, 0, 0);
    case AovKind::prim_index: return Vec3(at.primitive, 0, 0);
    case AovKind::optical_depth: return first.optical_depth;
    case AovKind::cryptomatte_object:
    case AovKind::cryptomatte_material: return Vec3(1);
  }
  return Vec3(0);
}

/// The layers of one pixel.
class PixelAovs {
 public:
  PixelAovs(const Scene& scene, const std::vector<Aov>& aovs)
      : scene_(scene), aovs_(aovs), values_(aovs.size()) {}

  const std::vector<Vec3>& render(const Vec2i& pixel, uint64_t stream) {
    std::fill(values_.begin(), values_.end(), Vec3(0));
    for (uint32_t i = 0; i < aov_samples; ++i) {
      PixelSampler sampler(stream, i);
      const Vec2 raster = Vec2(pixel) + sampler.next2();
      const Ray ray = camera_ray(scene_.camera(), raster, sampler).ray;
      add(ray, scene_.has_passages() ? sampler.next() : 0);
    }
    set_indices(middle_ray(pixel));
    return values_;
  }

 private:
  Ray middle_ray(const Vec2i& pixel) const {
    const Camera& camera = scene_.camera();
    const SurfacePoint lens = camera.sample_position({0.5, 0.5}, camera.time(0.5)).at;
    return camera_ray(camera, lens, Vec2(pixel) + 0.5);
  }
  void add(const Ray& ray, double u_leg) {
    const FirstSurface first = first_surface(scene_, ray, u_leg);
    for (size_t i = 0; i < aovs_.size(); ++i)
      values_[i] += value(aovs_[i].kind, scene_, ray, first) * (1.0 / aov_samples);
  }
  void set_indices(const Ray& ray) {
    const FirstSurface first = first_surface(scene_, ray, 0.5);
    for (size_t i = 0; i < aovs_.size(); ++i)
      if (is_index(aovs_[i].kind)) values_[i] = value(aovs_[i].kind, scene_, ray, first);
  }

  const Scene& scene_;
  const std::vector<Aov>& aovs_;
  std::vector<Vec3> values_;
};

/// Parses one layer.
Aov parse_aov(std::string_view item) {
  const size_t colon = item.find(':'), slash = item.rfind('/');
  const size_t begin = colon == std::string_view::npos ? 0 : colon + 1;
  const bool has_levels = slash != std::string_view::npos && slash >= begin;
  const size_t end = has_levels ? slash : item.size();
  const std::string_view kind = trim(item.substr(begin, end - begin));
  const std::string_view name = begin == 0 ? kind : trim(item.substr(0, colon));
  Aov aov{std::string(name), kind_of(std::string(kind))};
  if (!has_levels) return aov;
  constexpr int64_t most_levels = 100;
  const int64_t levels = parse_integer(item.substr(slash + 1)).value_or(0);
  if (!is_cryptomatte(aov.kind) || levels < 1 || levels > most_levels)
    throw UsageError(fmt::format(
        "{} is not a layer that can be rendered; only cryptomatte_object and cryptomatte_material "
        "have a number, of levels, from 1 to {}",
        quote(item), most_levels));
  aov.levels = static_cast<int>(levels);
  return aov;
}

/// The names of the layers in which it is kept.
std::vector<std::string> layers_of(const Aov& aov) {
  return is_cryptomatte(aov.kind) ? cryptomatte_layers(aov) : std::vector{aov.name};
}

}  // namespace

Vec3 aov_value(AovKind kind, const Scene& scene, const Ray& ray, double u_leg) {
  const Vec3 found = value(kind, scene, ray, first_surface(scene, ray, u_leg));
  return channels(kind) == 1 ? Vec3(found.x) : found;
}

std::vector<Aov> parse_aovs(const std::string& list) {
  std::vector<Aov> aovs;
  std::set<std::string> names;
  for (size_t begin = 0; begin <= list.size();) {
    const size_t end = std::min(list.find(',', begin), list.size());
    const std::string item(trim(std::string_view(list).substr(begin, end - begin)));
    begin = end + 1;
    if (item.empty()) continue;
    const size_t colon = item.find(':');
    if (colon == 0) throw UsageError("the layer '" + item + "' has no name before its colon");
    aovs.push_back(parse_aov(item));
    for (const std::string& name : layers_of(aovs.back())) {
      if (name == "alpha")
        throw UsageError("no layer can be called 'alpha', which the image has by --alpha");
      if (!names.insert(name).second)
        throw UsageError("the layer '" + name + "' is asked for twice; give it two names");
    }
  }
  return aovs;
}

std::vector<NamedImage> render_aovs(const Scene& scene, std::vector<Aov> aovs, uint64_t seed,
                                    int threads) {
  const auto has_ids = [](const Aov& aov) { return is_cryptomatte(aov.kind); };
  aovs.erase(std::remove_if(aovs.begin(), aovs.end(), has_ids), aovs.end());
  const Vec2i size = scene.camera().raster().size;
  std::vector<NamedImage> layers;
  for (const Aov& aov : aovs)
    layers.push_back({aov.name, Image(size.x, size.y, channels(aov.kind))});
  if (aovs.empty()) return layers;
  parallel_for(threads, static_cast<uint64_t>(size.y), [&](uint64_t row) {
    const int y = static_cast<int>(row);
    PixelAovs pixel(scene, aovs);
    for (int x = 0; x < size.x; ++x) {
      const uint64_t cell = (row << 32) | static_cast<uint32_t>(x);
      const std::vector<Vec3>& values = pixel.render({x, y}, mix_bits(mix_bits(seed) ^ cell));
      for (size_t i = 0; i < aovs.size(); ++i)
        for (int c = 0; c < layers[i].image.channels; ++c)
          layers[i].image.at(x, y, c) = static_cast<float>(values[i][c]);
    }
  });
  return layers;
}

}  // namespace mlt
