#include "scene/bsdf/bent_normal.h"

#include "scene/bsdf/eight_points.h"
#include "scene/bsdf/lobes.h"
#include "scene/nested.h"

namespace mlt {
namespace {

/// Whether w is on the same side of the surface and of the surface with the normal n.
bool faces(const Vec3& n, const Vec3& w) { return w.z * dot(w, n) > 0; }

/// Conty Estevez et al. 2019, eq. 4, with the roughness of eq. 5: G1 of GGX.
double shadowing(const Vec3& n, const Vec3& wl) {
  const double alpha2 = std::min(0.125 * sin2_theta(n) / sqr(n.z), 1.0);
  return 2 / (1 + std::sqrt(1 + alpha2 * sin2_theta(wl) / sqr(wl.z)));
}

}  // namespace

/// The bent surface at one point, with N or with N turned around.
class BentNormal::Bend {
 public:
  Bend(const SurfacePoint& at, const Vec3& n, bool turned)
      : frame_(Frame::around(turned ? reflect(n) : n, {1, 0, 0})), at_(at) {
    const Frame& outer = at.shading;
    at_.shading = {outer.to_world(frame_.s), outer.to_world(frame_.t), outer.to_world(frame_.n)};
  }
  const SurfacePoint& at() const { return at_; }
  const Vec3& n() const { return frame_.n; }
  Vec3 to_inner(const Vec3& w) const { return frame_.to_local(w); }
  Vec3 to_outer(const Vec3& w) const { return frame_.to_world(w); }

 private:
  Frame frame_;
  SurfacePoint at_;
};

BentNormal::BentNormal(Params& params)
    : nested_(only_nested<Bsdf>(params, "bsdf")),
      flips_(params.boolean("flip_invalid_normals")),
      shadows_(params.boolean("use_shadowing_function")) {
  supports_lanes_ = nested_->supports_lanes();
  inside_ = nested_->inside();
  glow_ = nested_->glow();
}

double BentNormal::turned_share(const Vec3& n, const Vec3& w) const {
  if (!flips_) return 0;
  if (!faces(n, w)) return 1;
  return faces(reflect(n), w) ? 0.5 * (1 - n.z) : 0;
}

bool BentNormal::scatters(const Vec3& n, bool turned, const Vec3& a, const Vec3& b,
                          Lobe lobe) const {
  if (turned != !(faces(n, a) && faces(n, b))) return false;
  if (turned && (!flips_ || lobe != Lobe::smooth)) return false;
  const Vec3 h = turned ? reflect(n) : n;
  return faces(h, a) && faces(h, b);
}

double BentNormal::factor(const Bend& bend, const Vec3& wl, Lobe lobe) const {
  const double cosines = lobe == Lobe::smooth ? std::abs(dot(bend.n(), wl) / wl.z) : 1;
  return shadows_ ? cosines * shadowing(bend.n(), wl) : cosines;
}

Passage BentNormal::passage(const SurfacePoint& at, const Vec3& w) const {
  const Vec3 n = normal(at);
  const Bend bend(at, n, !faces(n, w));
  return nested_->passage(bend.at(), bend.to_inner(w));
}

Scattering BentNormal::scattering(const SurfacePoint& at, const Vec3& wl, const Vec3& wc,
                                  Lobe lobe) const {
  const Vec3 n = normal(at);
  const bool turned = !(faces(n, wl) && faces(n, wc));
  if (!scatters(n, turned, wl, wc, lobe)) return {};
  const Bend bend(at, n, turned);
  Scattering s = nested_->scattering(bend.at(), bend.to_inner(wl), bend.to_inner(wc), lobe);
  const double share_l = turned_share(n, wl), share_c = turned_share(n, wc);
  s.pdf_from_light *= turned ? share_l : 1 - share_l;
  s.pdf_from_camera *= turned ? share_c : 1 - share_c;
  if (turned && faces(n, wc)) s.f = Spectrum(0);  // the camera side sees the unturned N
  s.f *= factor(bend, wl, lobe);
  return s;
}

/// Points where N is turned around, for the light or for the sample, are done one by one.
void BentNormal::scatter(ScatteringLanes& x) const {
  ScatteringLanes inner;
  Block<std::optional<Bend>> bends;
  Block<int> outer;
  for (int i = 0; i < x.count; ++i) {
    const Vec3 n = normal(*x.at[i]), wc(x.wc[i]), wl(x.wl[i]);
    const double share = turned_share(n, wc), rest = (x.u_lobe[i] - share) / (1 - share);
    const bool is_lit = wl.z != 0;
    if (!faces(n, wc) || rest < 0 || (is_lit && !faces(n, wl))) {
      scatter_one(*this, x, i);
      continue;
    }
    const int j = inner.count++;
    outer[j] = i;
    const Bend& bend = bends[j].emplace(*x.at[i], n, false);
    inner.at[j] = &bend.at();
    inner.wc.set(j, Vec3f(bend.to_inner(wc)));
    inner.wl.set(j, Vec3f(bend.to_inner(wl)));
    inner.u_lobe[j] = below_one(rest);
    inner.u_x[j] = x.u_x[i];
    inner.u_y[j] = x.u_y[i];
  }
  if (inner.count > 0) nested_->scatter(inner);
  for (int j = 0; j < inner.count; ++j) {
    const int i = outer[j];
    const Bend& bend = *bends[j];
    const Vec3 wl(x.wl[i]), to = bend.to_outer(Vec3(inner.to[j]));
    const double unturned = 1 - turned_share(bend.n(), Vec3(x.wc[i]));
    x.pdf_light[i] = static_cast<float>(inner.pdf_light[j] * unturned);
    x.f_light[i] = wl.z != 0 ? inner.f_light[j] * factor(bend, wl, Lobe::smooth) : Spectrum(0);
    x.to.set(i, Vec3f(to));
    const bool goes_on = inner.pdf[j] > 0 && faces(bend.n(), to);
    x.pdf[i] = goes_on ? static_cast<float>(inner.pdf[j] * unturned) : 0;
    x.f[i] = goes_on ? inner.f[j] * factor(bend, to, Lobe::smooth) : Spectrum(0);
  }
}

std::optional<BsdfSample> BentNormal::sample(const SurfacePoint& at, const Vec3& from,
                                             const Vec3& u) const {
  const Vec3 n = normal(at);
  const double share = turned_share(n, from);
  const bool turned = u.x < share;
  const Bend bend(at, n, turned);
  if (!faces(bend.n(), from)) return std::nullopt;
  const double rest = turned ? u.x / share : (u.x - share) / (1 - share);
  auto sampled = nested_->sample(bend.at(), bend.to_inner(from), {rest, u.y, u.z});
  if (!sampled) return std::nullopt;
  sampled->to = bend.to_outer(sampled->to);
  if (!scatters(n, turned, from, sampled->to, sampled->lobe)) return std::nullopt;
  return sampled;
}

std::optional<Vec3> BentNormal::invert(const SurfacePoint& at, const Vec3& from, const Vec3& to,
                                       Lobe lobe, const Vec3& v) const {
  const Vec3 n = normal(at);
  const double share = turned_share(n, from);
  const bool turned = !(faces(n, from) && faces(n, to));
  if (!scatters(n, turned, from, to, lobe) || !((turned ? share : 1 - share) > 0))
    return std::nullopt;
  const Bend bend(at, n, turned);
  auto u = nested_->invert(bend.at(), bend.to_inner(from), bend.to_inner(to), lobe, v);
  if (u) u->x = turned ? u_of_first(share, u->x) : u_of_second(share, u->x);
  return u;
}

double BentNormal::roughness(const SurfacePoint& at, const Vec3& wl, const Vec3& wc) const {
  const Vec3 n = normal(at);
  const Bend bend(at, n, !(faces(n, wl) && faces(n, wc)));
  return nested_->roughness(bend.at(), bend.to_inner(wl), bend.to_inner(wc));
}

Vec3 BentNormal::delta_normal(const SurfacePoint& at, const Vec3& w) const {
  const Bend bend(at, normal(at), false);
  return bend.to_outer(nested_->delta_normal(bend.at(), bend.to_inner(w)));
}

Schema bent_normal_schema(const std::string& name, const std::string& doc,
                          std::vector<Parameter> parameters) {
  parameters.push_back({"flip_invalid_normals", ParamType::boolean, true,
                        "Turn a bent normal around that would be seen from behind."});
  parameters.push_back({"use_shadowing_function", ParamType::boolean, true,
                        "Dim light that grazes the surface, where the normal is bent."});
  Schema schema{"bsdf", name, doc, std::move(parameters)};
  schema.conserves_energy = false;
  schema.reciprocal = false;
  schema.unnamed_texture = true;
  return schema;
}

}  // namespace mlt
