// Materials to test, made as a scene makes them (through their plug-in) but without a registry.
#pragma once

#include "base/registry.h"
#include "base/rng.h"
#include "scene/bsdf/bsdf.h"

#include <string>
#include <utility>
#include <vector>

namespace mlt::test {

using Given = std::vector<std::pair<std::string, Value>>;

const Schema& bsdf_schema(const std::string& name);

/// Checks and reads the parameters as the loader does; throws SceneError.
BsdfPtr make_bsdf(const std::string& name, const Given& given = {},
                  const std::vector<BsdfPtr>& nested = {});

/// A value that rises linearly from `low` to `high` along u.
ObjectPtr ramp_texture(double low, double high);

struct Case {
  std::string label;
  BsdfPtr bsdf;
  bool conserves_energy;
  bool reciprocal;
  bool two_sided;         ///< Scatters light from below, too.
  double lost_samples;    ///< The largest share of samples that may come to nothing.
  double max_weight;      ///< Bound of f cos / pdf, where the sampling promises one.
  bool symmetric = true;  ///< Is f(wl, wc) / eta_c^2 the same with wl and wc exchanged?
};

/// Every model, with several parameters.
const std::vector<Case>& cases();
const Case& find_case(const std::string& label);

/// A point where textures have their middle value.
SurfacePoint point();

/// Directions from near the normal to near the horizon, on both sides if the case is two-sided.
std::vector<Vec3> incident_directions(const Case& test_case);

Vec3 random_direction(Rng& rng);
Vec3 random_u(Rng& rng);

constexpr Lobe lobes[] = {Lobe::smooth, Lobe::reflection, Lobe::transmission};

/// f |cos| / pdf of light from `wl` that does not pass and is scattered to `s.to`; for a delta lobe
/// F / P.
Spectrum weight_from_light(const Bsdf& bsdf, const Vec3& wl, const BsdfSample& s);

}  // namespace mlt::test
