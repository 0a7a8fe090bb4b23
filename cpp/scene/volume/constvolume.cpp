// One value everywhere, or in a box.
#include "base/registry.h"
#include "scene/texture/texture.h"
#include "scene/transform/transform_params.h"
#include "scene/volume/grid_volume.h"

namespace mlt {
namespace {

class ConstVolume final : public Volume {
 public:
  explicit ConstVolume(const SpectralColor& value)
      : value_(value.meaning(RgbMeaning::coefficient)), light_(value.meaning(RgbMeaning::light)) {}

  Spectrum at(const Vec3&, double wavelength) const override { return value_.at(wavelength); }
  Spectrum light_at(const Vec3&, double wavelength) const override { return light_.at(wavelength); }
  Color maximum() const override { return value_.rgb(); }
  bool grey() const override { return value_.grey(); }
  Flight fly(const Ray& ray, const FlightLimit& limit, double scale) const override {
    return uniform_flight(scale * value_.at(ray.wavelength), limit);
  }

 private:
  SpectralColor value_, light_;
};

/// In a box it is a grid of one value.
std::shared_ptr<Volume> make_const(Params& params) {
  if (!params.has("to_world"))
    return std::make_shared<ConstVolume>(spectral_param(params, "value"));
  const Color value = color_param(params, "value");
  const GridData one{{1, 1, 1}, 3, {float(value.x), float(value.y), float(value.z)}};
  return std::make_shared<GridVolume>(Grid(one, true, "'value'"), matrix_param(params, "to_world"));
}

}  // namespace

VolumePtr volume_param(Params& params, const std::string& name) {
  const ObjectPtr* object = std::get_if<ObjectPtr>(&params.value(name));
  if (!object || std::dynamic_pointer_cast<Texture>(*object))
    return std::make_shared<ConstVolume>(spectral_param(params, name));
  VolumePtr volume = std::dynamic_pointer_cast<const Volume>(*object);
  if (!volume) params.fail(name, "is an object, but not a volume");
  return volume;
}

Plugin volume_constvolume() {
  return {{"volume",
           "constvolume",
           "The same value everywhere, or in the unit cube, where to_world moves it.",
           {{"value", ParamType::radiance, 1.0, "The value."},
            {"to_world", ParamType::transform, no_default,
             "Where the unit cube is; without it the value is everywhere."}}},
          make_const};
}

}  // namespace mlt
