// Makes the objects that a tree of nodes describes, innermost first.
#pragma once

#include "base/registry.h"
#include "io/load.h"
#include "io/node.h"
#include "io/origins.h"
#include "io/parts.h"
#include "scene/shape/shape_reader.h"

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace mlt {

class Builder {
 public:
  /// References are looked up in `root`, which must outlive the builder, as `known` must.
  Builder(const Node& root, const Registry& registry, std::vector<std::string>& warnings,
          const Known* known = nullptr, Origins origins = {});

  /// The object of a node, made at the first call: all references to it share one object.
  ObjectPtr object(const Node& node);

  /// A shape with its BSDF and its light attached; nullptr for a group of shapes.
  ShapePtr shape(const Node& node);

  struct View {
    CameraPtr camera;
    std::shared_ptr<FilmSettings> film;
    int64_t sample_count = 0;
  };
  /// A camera whose raster is set from its film. `size` replaces the film's own size and crop
  /// window.
  View view(const Node& sensor, const std::optional<Vec2i>& size);

  /// Gives the shapes of the finished scene to the plug-ins that read them (ShapeReader).
  void show_shapes(const std::vector<ShapePtr>& shapes) const {
    for (const auto& reader : shape_readers_) reader->read_shapes(shapes);
  }

  /// The origins with which the groups that were made, and a scene in these bounds, are near 0.
  Origins better_origins(const Bounds& scene) const;

  /// The parts that were made, for scenes that are nearly the same.
  Parts take_parts() { return std::move(parts_); }
  /// The names of the files that were read.
  const std::set<std::string>& files() const { return files_; }

  /// A light without light, for scenes that have none.
  EmitterPtr black_light(const Location& where) {
    return std::dynamic_pointer_cast<Emitter>(
        make({"emitter", "constant", "", "", where, {{"radiance", 0.0, where}}, {}}));
  }

  /// Whether a shape has taken this node as its light.
  bool on_a_shape(const Node& emitter) const { return lights_of_shapes_.count(&emitter) > 0; }

 private:
  const Node& resolve(const Node& child) const;
  ObjectPtr make(const Node& node);
  void check_size(const Node& node);
  void move(const Node& node, Params& params) const;
  Part new_part(const Node& node, const Plugin& plugin, Params& params);
  void give(Params& params, const Node& parent, const Node& child);
  void attach(Shape& shape, Params& params);
  void take_animation(Params& params, const std::string& name, bool by_shutter) const;
  BsdfPtr default_bsdf(bool on_light, const Location& where);

  NodeIndex index_;
  Shutter shutter_;  ///< Shutter of the view, once that is made.
  const Registry& registry_;
  std::vector<std::string>& warnings_;
  const Known* known_;
  Origins origins_;
  PartSource known_parts_;
  Parts parts_;
  std::set<std::string> files_;
  std::map<const Node*, ObjectPtr> made_;
  std::vector<const Node*> in_progress_;
  std::map<const Node*, size_t> sizes_;  ///< Sizes of BSDFs and textures, in parts.
  std::set<const Node*> lights_of_shapes_;
  std::map<const Object*, View> views_;
  BsdfPtr default_bsdf_[2];
  std::map<BsdfPtr, MediumPtr> inside_;  ///< The media of materials that bring their own.
  std::vector<std::shared_ptr<ShapeReader>> shape_readers_;
};

}  // namespace mlt
