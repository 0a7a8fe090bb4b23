// Functions that make emitter plug-ins.
#pragma once

#include "base/registry.h"
#include "scene/emitter/emitter.h"

namespace mlt {

inline Parameter sampling_weight_parameter() {
  return {"sampling_weight", ParamType::real, 1.0,
          "A factor of the probability with which this light is sampled, not of its brightness."};
}
inline double read_sampling_weight(Params& params) {
  return params.real_in("sampling_weight", 0, 1e9);
}

/// The plug-in whose lights are made by `make(params)`, with the parameter that all of them have.
template <class Make>
Plugin emitter_plugin(const char* name, const char* doc, std::vector<Parameter> parameters,
                      std::vector<std::string> ignored, Make make) {
  parameters.push_back(sampling_weight_parameter());
  return {{"emitter", name, doc, std::move(parameters), std::move(ignored)},
          [make](Params& params) -> ObjectPtr {
            const EmitterPtr emitter = make(params);
            emitter->set_sampling_weight(read_sampling_weight(params));
            return emitter;
          }};
}
/// The plug-in whose lights are made by `T(params)`, as above.
template <class T>
Plugin make_emitter_plugin(const char* name, const char* doc, std::vector<Parameter> parameters,
                           std::vector<std::string> ignored = {}) {
  return emitter_plugin(name, doc, std::move(parameters), std::move(ignored),
                        [](Params& params) { return std::make_shared<T>(params); });
}

}  // namespace mlt
