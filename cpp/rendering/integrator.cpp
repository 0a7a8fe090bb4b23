#include "rendering/integrator.h"

#include "base/error.h"

namespace mlt {

Image Rendering::shown(Image image) const {
  const Camera& camera = scene().camera();
  if (!camera.records_xyz() && camera.response() == 1) return image;
  for (size_t i = 0; i < image.data.size(); i += 3) {
    float* const pixel = &image.data[i];
    const Color rgb = mlt::shown(scene(), {pixel[0], pixel[1], pixel[2]});
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(rgb[c]);
  }
  return image;
}

void Rendering::keep_light_layers(const LightLayerSettings& settings) {
  if (settings.any()) light_layers_ = std::make_unique<LightLayers>(scene(), settings);
}

Image Rendering::sum_of_lamps() const {
  Image sum = image(0);
  for (int layer = 1; layer < light_layers_->group_count(); ++layer) sum += image(layer);
  return sum;
}

Replay Rendering::replay(const Vec2i& /*pixel*/, uint64_t /*sample*/) {
  throw UsageError(
      "this integrator takes no samples of single pixels to be replayed; path, direct, "
      "ptracer and bdpt do");
}

IntegratorPtr Integrator::with_mutations(const std::vector<ExtraMutation>& /*extra*/) const {
  throw UsageError("'" + name() + "' has no mixture of mutations; mlt has");
}

Schema integrator_schema(const std::string& name, const std::string& doc,
                         const std::vector<std::vector<Parameter>>& parameters) {
  Schema schema;
  schema.family = "integrator";
  schema.name = name;
  schema.doc = doc;
  for (const std::vector<Parameter>& list : parameters)
    schema.parameters.insert(schema.parameters.end(), list.begin(), list.end());
  return schema;
}

}  // namespace mlt
