// Mitsuba 0.6's sum of any number of materials with constant weights: blends of blends.
#include "base/registry.h"
#include "scene/bsdf/blend.h"

#include <cmath>
#include <sstream>

namespace mlt {
namespace {

/// The weights: numbers between commas or blanks.
std::vector<double> weights_param(Params& params) {
  std::string text = params.text("weights");
  for (char& c : text)
    if (c == ',') c = ' ';
  std::istringstream in(text);
  std::vector<double> weights;
  for (double w; in >> w;) weights.push_back(w);
  if (!in.eof()) params.fail("weights", "should be numbers, not '" + text + "'");
  for (const double w : weights)
    if (!(w >= 0) || !std::isfinite(w)) params.fail("weights", "must not be negative");
  return weights;
}

ObjectPtr create_mixture(Params& params) {
  const auto nested = params.objects<Bsdf>("bsdf");
  const std::vector<double> weights = weights_param(params);
  if (nested.empty() || nested.size() != weights.size())
    params.fail(fmt::format("has {} weights for {} nested bsdfs", weights.size(), nested.size()));
  double sum = 0;
  for (const double w : weights) sum += w;
  if (!(sum > 0)) params.fail("weights", "are all 0");
  if (sum > 1) params.warn("the weights add up to more than 1 and are divided by their sum");
  // from the last one forwards: each is blended with those behind it
  BsdfPtr rest = nested.back();
  double behind = weights.back();
  std::shared_ptr<Blend> all;
  for (size_t i = std::max<size_t>(nested.size() - 1, 1); i-- > 0;) {
    if (nested.size() > 1) behind += weights[i];
    const double share = behind > 0 ? 1 - weights[i] / behind : 0.5;
    const double scale = i == 0 ? std::min(sum, 1.0) : 1;
    all = std::make_shared<Blend>(nested[i], rest, constant_texture(share), scale, params);
    rest = all;
  }
  return all;
}

}  // namespace

Plugin bsdf_mixturebsdf() {
  Schema schema{
      "bsdf",
      "mixturebsdf",
      "The sum of nested bsdfs, each with its weight.",
      {{"weights", ParamType::text, no_default,
        "One number for each nested bsdf, in their order. If they add up to less than 1, "
        "the rest of the light is absorbed; if to more, they are divided by their sum."}}};
  schema.reciprocal = false;  // one of them may refract
  return {schema, create_mixture};
}

}  // namespace mlt
