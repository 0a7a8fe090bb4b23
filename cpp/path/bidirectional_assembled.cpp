// Paths that an extra technique of BidirectionalSampler has assembled (ExtraTechnique): their
// contribution and weight follow from the terms of the whole path.
#include "path/bidirectional_sampler.h"

namespace mlt {

/// Completes a path that ends in camera vertex t - 1, at which it is joined, and finds its terms.
void BidirectionalSampler::complete_assembled(const Connection& connection) {
  assembled_[connection.s].lobe = Lobe::smooth;
  for (int j = connection.t - 2; j >= 0; --j) assembled_.vertices.push_back(camera_[j].vertex);
  assembled_.time = time_;
  assembled_.wavelength = wavelength_;
  compute_terms(*scene_, assembled_, {settings_.sample_direct, settings_.rules.strict_normals},
                assembled_terms_);
}

/// Finds what the technique contributes; false if that is nothing.
bool BidirectionalSampler::evaluate_assembled(const ExtraTechnique& technique,
                                              Connection& connection) {
  const int s = connection.s, t = connection.t;
  const PathTerms& terms = assembled_terms_;
  if (!(technique.count > 0) || !terms.raster) return false;
  const WalkVertex& y = camera_[t - 1];
  const Vec3 wl = terms.direction(s, -1), wc = t > 1 ? terms.direction(s, 1) : Vec3(0);
  const VertexTerms at_y =
      vertex_terms(*scene_, assembled_[s], wl, wc, settings_.rules.strict_normals);
  Spectrum value = y.throughput * at_y.f / technique.count;
  bool dispersed = y.dispersed || at_y.disperses;
  for (int i = 0; i < s; ++i) {
    value *= terms[i].vertex.f * (terms[i].G / terms[i].from_light);
    dispersed = dispersed || terms[i].vertex.disperses;
  }
  if (is_black(value)) return false;
  const MisWeights weights = mis_weights(terms, technique, settings_.heuristic);
  connection.assembled = true;
  connection.raster = *terms.raster;
  connection.contribution = recorded(value, wavelength_, dispersed);
  connection.certainty = certainty(terms);
  connection.weight = weights.chosen;
  connection.survival = y.survival;
  connection.own_share = weights.balance * y.survival;
  return connection.weight > 0;
}

}  // namespace mlt
