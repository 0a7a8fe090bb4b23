// What fills the space between surfaces: fog, milk, smoke, fire. Light is absorbed, scattered and
// emitted there (Chandrasekhar 1960, "Radiative transfer"; Pharr et al., PBRT 3rd ed., sec. 11.1).
#pragma once

#include "base/object.h"
#include "math/spectrum.h"
#include "scene/bsdf/bsdf.h"
#include "scene/medium/flight.h"
#include "scene/passage.h"

#include <optional>

namespace mlt {

class Params;

/// Per unit of length.
struct MediumCoefficients {
  Spectrum extinction{0};  ///< sigma_t: of the light along a ray, what is absorbed or scattered.
  Spectrum scattering{0};  ///< sigma_s: the part of it that is scattered.

  /// sigma_a, the part that is absorbed.
  Spectrum absorption() const { return max(extinction - scattering, Spectrum(0)); }
};

class Medium : public Object {
 public:
  /// `phase` is the phase function: a Bsdf without a surface, so that its densities and values are
  /// per solid angle; its directions are those of the world.
  explicit Medium(BsdfPtr phase) : phase_(std::move(phase)) {}

  /// `wavelength`: that of the path (wavelengths.h).
  virtual MediumCoefficients at(const Vec3& p, double wavelength) const = 0;
  /// How far light flies along a ray through the medium.
  virtual Flight fly(const Ray& ray, const FlightLimit& limit) const = 0;
  /// Whether light is scattered, and not only absorbed.
  virtual bool scatters() const = 0;
  /// The light that comes from a point into each direction, per unit of length: sigma_a L_e, where
  /// L_e is the radiance of the medium where it is thick (PBRT 4th ed., sec. 11.1.2). So what
  /// absorbs nothing emits nothing.
  virtual Spectrum emission(const Vec3& /*p*/, double /*wavelength*/) const { return Spectrum(0); }
  virtual bool emits() const { return false; }
  /// Whether what it emits varies in space.
  virtual bool varies() const { return false; }
  /// Whether walks stop in the medium.
  bool stops_walks() const { return scatters() || emits(); }
  /// Whether the extinction is the same in all channels.
  virtual bool grey() const = 0;

  const Bsdf& phase() const { return *phase_; }

 private:
  BsdfPtr phase_;
};

using MediumPtr = std::shared_ptr<const Medium>;

/// Throws SceneError for an extinction whose free paths are too short.
void check_extinction(const Params& params, double greatest);

/// Adds what a medium lets pass of the light along a ray, up to a distance.
void fly(const Medium& medium, const Ray& ray, double distance, Passage& passed);
/// Flies along the ray of a walk that stops where the probability of having come so far is `u_leg`:
/// returns the distance at which it stops in the medium, or nullopt, and rescales u_leg to what
/// comes after it. With u_leg = 0 it flies on.
std::optional<double> fly(const Medium& medium, const Ray& ray, double distance, double& u_leg,
                          Passage& passed);

}  // namespace mlt
