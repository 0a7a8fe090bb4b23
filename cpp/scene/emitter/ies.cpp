// A luminaire of no size with the intensities of a photometric file. In its own space straight down
// is -z, and the horizontal angle of the file grows from +x towards +y. Candelas become watts per
// steradian, by 683 lumens per watt.
#include "base/atomic_file.h"
#include "scene/emitter/emitter_plugin.h"
#include "scene/emitter/ies_file.h"
#include "scene/emitter/intensity_table.h"
#include "scene/emitter/isolated.h"
#include "scene/texture/texture.h"
#include "scene/transform/orientation.h"

namespace mlt {
namespace {

constexpr double lumens_per_watt = 683;

IntensityTable read_table(Params& params) {
  const std::string path = params.text("filename");
  constexpr uint64_t largest = uint64_t{1} << 26;
  IesProfile profile = parse_ies(read_file(path, largest), path);
  for (double& angle : profile.vertical) angle *= degree;
  for (double& angle : profile.horizontal) angle *= degree;
  for (double& intensity : profile.candela) intensity /= lumens_per_watt;
  try {
    return {profile.vertical, profile.horizontal, profile.candela};
  } catch (const UsageError&) {
    params.fail("filename", "has no candela value above 0: " + path);
  }
}

class Luminaire final : public TurnedEmitter {
 public:
  explicit Luminaire(Params& params)
      : TurnedEmitter(turning_motion_param(params), turned_axes),
        table_(read_table(params)),
        scale_(spectral_param(params, "scale")) {}

  Spectrum eval(const SurfacePoint& x0, const Vec3& w) const override {
    return scale_.at(x0.wavelength) * table_.at(local(x0, w));
  }

  RaySample sample_ray(const SurfacePoint& x0, const Vec2& u) const override {
    const Vec3 w = axes(x0.time).to_world(from_below(table_.sample(u)));
    return {x0.p, w, pdf_ray(x0, w)};
  }
  double pdf_ray(const SurfacePoint& x0, const Vec3& w) const override {
    return table_.pdf(local(x0, w));
  }
  Vec2 invert_ray(const SurfacePoint& x0, const Vec3& x1) const override {
    return table_.invert(local(x0, normalize(x1 - x0.p)));
  }

  Color power() const override { return scale_.rgb() * table_.integral(); }

 private:
  /// From the space of the table, where the axis points down, and back.
  static Vec3 from_below(const Vec3& w) { return {w.x, w.y, -w.z}; }
  Vec3 local(const SurfacePoint& x0, const Vec3& w) const {
    return from_below(axes(x0.time).to_local(w));
  }

  IntensityTable table_;
  SpectralColor scale_;
};

}  // namespace

Plugin emitter_ies() {
  return make_emitter_plugin<Luminaire>(
      "ies", "A light of no size with the intensities of a luminaire's photometric file.",
      {{"filename", ParamType::text, no_default, "The .ies file (IESNA LM-63)."},
       {"scale", ParamType::radiance, 1.0,
        "Multiplies the file's candelas / 683: a number, or a color."},
       {"to_world", ParamType::motion, no_default,
        "Moves and turns it: straight down is -z, and horizontal angles grow from +x to +y."}});
}

}  // namespace mlt
