// Blanco-Muriel et al. 2001, "Computing the solar vector", Solar Energy 70(5), exact to half an
// arc minute from 1999 to 2015.
#include "scene/emitter/sun_position.h"

#include "scene/texture/texture.h"
#include "scene/transform/orientation.h"
#include "scene/transform/transform_params.h"

namespace mlt {
namespace {

struct Moment {
  int64_t year, month, day;
  double hours;  ///< Universal time, since midnight.
};

/// Days since noon of January 1, 2000.
double days_since_2000(const Moment& at) {
  const int64_t m = (at.month - 14) / 12;
  const int64_t julian = (1461 * (at.year + 4800 + m)) / 4 + (367 * (at.month - 2 - 12 * m)) / 12 -
                         (3 * ((at.year + 4900 + m) / 100)) / 4 + at.day - 32075;
  return static_cast<double>(julian) - 0.5 + at.hours / 24 - 2451545;
}

/// The position of the sun on the celestial sphere.
struct Equatorial {
  double right_ascension, declination;
};

Equatorial sun_among_stars(double days) {
  const double omega = 2.1429 - 0.0010394594 * days;
  const double mean_longitude = 4.8950630 + 0.017202791698 * days;
  const double anomaly = 6.2400600 + 0.0172019699 * days;
  const double longitude = mean_longitude + 0.03341607 * std::sin(anomaly) +
                           0.00034894 * std::sin(2 * anomaly) - 0.0001134 -
                           0.0000203 * std::sin(omega);
  const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(omega);
  return {std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude)),
          std::asin(std::sin(obliquity) * std::sin(longitude))};
}

Vec3 sun_above(const Moment& at, double latitude, double longitude) {
  const double days = days_since_2000(at);
  const auto [right_ascension, declination] = sun_among_stars(days);
  const double sidereal_hours = 6.6974243242 + 0.0657098283 * days + at.hours;
  const double hour_angle = sidereal_hours * 15 * degree + longitude - right_ascension;
  const double east = -std::cos(declination) * std::sin(hour_angle);
  const double north = std::sin(declination) * std::cos(latitude) -
                       std::cos(declination) * std::sin(latitude) * std::cos(hour_angle);
  const double up = std::cos(declination) * std::cos(latitude) * std::cos(hour_angle) +
                    std::sin(declination) * std::sin(latitude);
  // Seen from the surface of the earth it stands lower than from its centre.
  constexpr double parallax = 6371.01 / 149597890;
  return normalize(Vec3(east, up - parallax, -north));
}

}  // namespace

std::vector<Parameter> sun_position_parameters() {
  const auto real = [](const char* name, double value, const char* doc) {
    return Parameter{name, ParamType::real, value, doc};
  };
  return {{"sun_direction", ParamType::point, no_default,
           "Towards the sun, in world space; in place of the place and the time."},
          real("latitude", 35.6894, "Degrees, north is positive."),
          real("longitude", 139.6917, "Degrees, east is positive."),
          real("timezone", 9, "Hours that local time is ahead of universal time."),
          {"year", ParamType::integer, int64_t{2010}, "Of the local date."},
          {"month", ParamType::integer, int64_t{7}, "1 to 12."},
          {"day", ParamType::integer, int64_t{10}, "1 to 31."},
          real("hour", 15, "Local time."),
          real("minute", 0, "Local time."),
          real("second", 0, "Local time.")};
}

Vec3 read_sun_position(Params& params) {
  Vec3 sun;
  if (params.has("sun_direction")) {
    const Vec3 world = vector_param(params, "sun_direction");
    if (!(length(world) > 0)) params.fail("sun_direction", "has no length");
    sun = orientation(params, "to_world", matrix_param(params, "to_world"))
              .to_local(normalize(world));
  } else {
    const Moment at{params.integer_in("year", 1, 9999), params.integer_in("month", 1, 12),
                    params.integer_in("day", 1, 31),
                    params.real_in("hour", 0, 24) - params.real_in("timezone", -14, 14) +
                        params.real_in("minute", 0, 60) / 60 +
                        params.real_in("second", 0, 60) / 3600};
    sun = sun_above(at, params.real_in("latitude", -90, 90) * degree,
                    params.real_in("longitude", -180, 180) * degree);
  }
  if (!(sun.y > 0)) params.fail("has its sun below the horizon, where the model knows no sky");
  return sun;
}

}  // namespace mlt
