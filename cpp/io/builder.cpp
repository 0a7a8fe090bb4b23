#include "io/builder.h"

#include "image/splat.h"

#include "base/text.h"
#include "io/families.h"
#include "io/leniency.h"
#include "io/material_parts.h"
#include "io/shape_parts.h"
#include "scene/accel/instance.h"
#include "scene/mesh/mesh.h"
#include "scene/nested.h"
#include "scene/shape/sphere.h"
#include "scene/texture/animation.h"
#include "scene/transform/motion.h"

#include <algorithm>
#include <new>

namespace mlt {
namespace {

/// Whether the builder itself takes this child out of its parent's parameters, whatever its name.
bool is_part(const std::string& parent, const std::string& child) {
  if (parent == "shape") return child == "bsdf" || child == "emitter" || child == "sensor";
  if (parent == "emitter") return child == "medium";
  return parent == "sensor" && (child == "film" || child == "sampler" || child == "medium");
}

/// Whether a nested object is given by its name. Textures always are, so that a misspelt name is an
/// error; in a dict every object has a name, and the family decides its use.
bool is_given_by_name(const Schema& schema, const std::string& name, const std::string& family) {
  if (name.empty()) return false;
  const std::string current = snake_case(name);
  const auto& ignored = schema.ignored;
  return schema.find(current) || (family == "texture" && !schema.unnamed_texture) ||
         std::find(ignored.begin(), ignored.end(), current) != ignored.end();
}

/// The side of a shape on which a medium is.
const std::string& side_of_medium(const Node& medium) {
  if (medium.name != "interior" && medium.name != "exterior")
    throw SceneError(at(medium.where,
                        "a medium of a shape should be named 'interior' or 'exterior'{}",
                        medium.name.empty() ? "" : ", not " + quote(medium.name)));
  return medium.name;
}

/// The sampler of another program; only its number of samples matters here.
std::shared_ptr<SamplerSettings> foreign_sampler(const Node& node) {
  auto sampler = std::make_shared<SamplerSettings>();
  for (const Node::Property& property : node.properties)
    if (const auto* count = std::get_if<int64_t>(&property.value))
      if (snake_case(property.name) == "sample_count" && *count > 0) sampler->sample_count = *count;
  return sampler;
}

/// What the plug-in makes; if its file holds more than there is memory for, the error names it.
ObjectPtr make_from_file(const Plugin& plugin, Params& params) {
  try {
    return make_object(plugin, params);
  } catch (const std::bad_alloc&) {
    if (!params.has("filename")) throw;
    throw FileError(params.text("filename") +
                    ": cannot read it: there is not enough memory for what it holds");
  }
}

/// Refuses a texture, or anything else in its place, that a parameter cannot have.
void check_texture(const Node& parent, const Node& child, const Node& target,
                   const Parameter& parameter, const ObjectPtr& nested) {
  const ParamType type = parameter.type;
  const bool textured = type == ParamType::texture || type == ParamType::emission;
  const bool coloured =
      type == ParamType::reflectance || type == ParamType::radiance || type == ParamType::lamp;
  const auto texture = std::dynamic_pointer_cast<Texture>(nested);
  const bool changes = std::dynamic_pointer_cast<AnimatedTexture>(nested) != nullptr;
  if (changes && (textured || type == ParamType::lamp || type == ParamType::object)) return;
  if (changes)
    throw SceneError(at(child.where, "{} '{}': '{}' cannot change over time", parent.family,
                        parent.type, parameter.name));
  const bool fits =
      textured ? texture != nullptr : texture && texture->spectrum(SpectrumUse::unbounded);
  if ((textured || coloured) && !fits)
    throw SceneError(at(child.where, "{} '{}': '{}' is a {}, but should be a {}", parent.family,
                        parent.type, parameter.name, target.family, to_string(type)));
}

}  // namespace

Builder::Builder(const Node& root, const Registry& registry, std::vector<std::string>& warnings,
                 const Known* known, Origins origins)
    : index_(index_nodes(root)),
      registry_(registry),
      warnings_(warnings),
      known_(known),
      origins_(std::move(origins)),
      known_parts_(known ? known->parts.get() : nullptr) {}

const Node& Builder::resolve(const Node& child) const {
  return child.family == "ref" ? find_node(index_, child.type, child.where) : child;
}

ObjectPtr Builder::object(const Node& node) {
  const auto known = made_.find(&node);
  if (known != made_.end()) return known->second;
  ObjectPtr object = make(node);
  made_[&node] = object;
  return object;
}

ObjectPtr Builder::make(const Node& node) {
  if (std::count(in_progress_.begin(), in_progress_.end(), &node))
    throw SceneError(at(node.where, "the {} {} contains itself", node.family, quote(node.id)));
  if (in_progress_.size() >= static_cast<size_t>(max_nesting))
    throw SceneError(at(node.where, "references are nested more than {} deep", max_nesting));
  refuse_element(node.family, node.type, node.where);
  if (node.family == "sampler" && !registry_.has(node.family, node.type)) {
    warnings_.push_back(at(node.where,
                           "sampler {} is not known here; only its sample_count is used",
                           quote(node.type)));
    return foreign_sampler(node);
  }
  const Plugin& plugin = registry_.find(node.family, node.type, node.where);
  Params params(plugin.schema, node.where, node.id);
  for (const Node::Property& property : node.properties) {
    const std::string name = current_name(node, property.name, plugin.schema);
    params.set(name, property.value, property.where);
    if (std::holds_alternative<Animation>(property.value))
      take_animation(params, snake_case(name), node.family != "sensor");
  }

  if (origins_.any()) move(node, params);
  if (node.family == "shape" && node.type == "sphere") place_ellipsoid(params);

  in_progress_.push_back(&node);
  for (const Node& child : node.children) give(params, node, child);
  in_progress_.pop_back();
  if (node.family == "bsdf" || node.family == "texture") check_size(node);

  const std::string key = params.key(attached(node.family));
  const Part* known = known_parts_.take(key);
  const Part part = known ? *known : new_part(node, plugin, params);
  warnings_.insert(warnings_.end(), part.warnings.begin(), part.warnings.end());
  ObjectPtr object = for_scene(part.object);
  if (object)
    parts_.emplace(key, Part{part.object, params.nested(), part.warnings});
  else
    object = part.object;
  if (const auto animated = std::dynamic_pointer_cast<AnimatedTexture>(object))
    object = animated->during(shutter_);
  if (auto reader = std::dynamic_pointer_cast<ShapeReader>(object))
    shape_readers_.push_back(std::move(reader));
  if (const auto shape = std::dynamic_pointer_cast<Shape>(object)) {
    attach(*shape, params);
    if (!shape->as_instance()) object = moving(shape, params);
  }
  if (const auto emitter = std::dynamic_pointer_cast<Emitter>(object))
    emitter->set_medium(optional_nested<Medium>(params, "medium"));
  if (const auto camera = std::dynamic_pointer_cast<Camera>(object)) {
    camera->set_medium(optional_nested<Medium>(params, "medium"));
    const auto sampler = optional_nested<SamplerSettings>(params, "sampler");
    views_[object.get()] = {camera, optional_nested<FilmSettings>(params, "film"),
                            sampler ? sampler->sample_count : 0};
  }
  if (!known) params.expect_all_read();
  return object;
}

Origins Builder::better_origins(const Bounds& scene) const {
  Origins origins{origin_of(scene), {}};
  for (const auto& [node, object] : made_)
    if (const auto group = std::dynamic_pointer_cast<ShapeGroup>(object))
      if (const Vec3 origin = origin_of(bounds_of_box(group->low(), group->high()));
          origin != Vec3(0))
        origins.groups[node] = origin;
  return origins;
}

/// Moves an object to where the new origins put it.
void Builder::move(const Node& node, Params& params) const {
  const auto group_origin = [&](const Node& group) {
    const auto found = origins_.groups.find(&group);
    return found == origins_.groups.end() ? Vec3(0) : found->second;
  };
  const Node* parent = in_progress_.empty() ? nullptr : in_progress_.back();
  const bool in_group = node.family == "shape" && parent && parent->type == "shapegroup";
  Vec3 before(0);
  for (const Node& child : node.children)
    if (node.type == "instance") before += group_origin(resolve(child));
  move_place(params, before, in_group ? group_origin(*parent) : origins_.scene);
}

/// Throws SceneError for runaway branching.
void Builder::check_size(const Node& node) {
  size_t size = 1;
  for (const Node& child : node.children) size += sizes_[&resolve(child)];
  if (size > max_parts)
    throw SceneError(at(
        node.where, "the {} is made of more than {} parts; what is referred to twice counts twice",
        node.family, max_parts));
  sizes_[&node] = size;
}

Part Builder::new_part(const Node& node, const Plugin& plugin, Params& params) {
  if (params.has("filename")) {
    const std::string name = params.text("filename");
    files_.insert(name);
    if (known_ && known_->moved_files.count(name))
      params.replace("filename", known_->moved_files.at(name));
  }
  const ObjectPtr object = make_from_file(plugin, params);
  object->type = node.type;
  object->id = node.id;
  object->where = node.where;
  // for all copies of the mesh
  if (auto mesh = std::dynamic_pointer_cast<Mesh>(object); mesh && params.has("emitter"))
    mesh->prepare_sampling();
  return {object, {}, params.warnings()};
}

void Builder::give(Params& params, const Node& parent, const Node& child) {
  const Node& target = resolve(child);
  // A light belongs to one shape, so each shape gets its own.
  const bool own = parent.family == "shape" && target.family == "emitter";
  if (own) lights_of_shapes_.insert(&target);
  ObjectPtr nested = own ? make(target) : object(target);

  const Schema& schema = params.schema();
  if (parent.family == "shape" && target.family == "medium")
    return params.add(side_of_medium(child), std::move(nested), child.where);
  if (is_part(parent.family, target.family) || !is_given_by_name(schema, child.name, target.family))
    return params.add(target.family, std::move(nested), child.where);
  const std::string name = current_name(parent, child.name, schema);
  const Parameter* parameter = schema.find(snake_case(name));
  if (parameter) check_texture(parent, child, target, *parameter, nested);
  params.set(name, std::move(nested), child.where);
}

void Builder::attach(Shape& shape, Params& params) {
  const BsdfPtr bsdf = optional_nested<Bsdf>(params, "bsdf");
  EmitterPtr emitter = optional_nested<Emitter>(params, "emitter");
  if (!emitter && bsdf && bsdf->glow()) emitter = light_of(*bsdf, registry_, params.where());
  if (params.has("priority")) shape.set_priority(params.integer("priority"));
  MediumPtr interior = params.object<Medium>("interior");
  if (!interior && bsdf && bsdf->inside()) {
    MediumPtr& inside = inside_[bsdf];  // one for all shapes of a material
    if (!inside) inside = medium_inside(*bsdf, registry_, params.where());
    interior = inside;
  }
  shape.set_media({interior, params.object<Medium>("exterior")});
  shape.set_bsdf(bsdf ? bsdf : default_bsdf(emitter != nullptr, params.where()));
  if (emitter) attach_light(shape, emitter);
  if (const auto sensor = optional_nested<Camera>(params, "sensor"))
    attach_sensor(shape, *sensor, params);
}

/// Checks an animation, and restricts it to the time of the shutter.
void Builder::take_animation(Params& params, const std::string& name, bool by_shutter) const {
  const Animation* animation = animation_param(params, name);
  if (!animation) return;  // without effect there
  const std::string problem = animation_problem(*animation);
  if (!problem.empty()) params.fail(name, problem);
  if (by_shutter) params.replace(name, during(*animation, shutter_));
}

/// The BSDF by default, as in Mitsuba: black for a light, grey and diffuse for other shapes.
BsdfPtr Builder::default_bsdf(bool on_light, const Location& where) {
  BsdfPtr& bsdf = default_bsdf_[on_light];
  const double reflectance = on_light ? 0.0 : 0.5;
  if (!bsdf)
    bsdf = std::dynamic_pointer_cast<Bsdf>(
        make({"bsdf", "diffuse", "", "", where, {{"reflectance", reflectance, where}}, {}}));
  return bsdf;
}

ShapePtr Builder::shape(const Node& node) { return std::dynamic_pointer_cast<Shape>(object(node)); }

Builder::View Builder::view(const Node& sensor, const std::optional<Vec2i>& size) {
  View view = views_.at(object(sensor).get());
  shutter_ = view.camera->shutter();
  if (!view.film)
    view.film = std::dynamic_pointer_cast<FilmSettings>(
        make({"film", "hdrfilm", "", "", sensor.where, {}, {}}));
  FilmSettings& film = *view.film;
  if (size) {
    film.size = *size;
    film.crop_offset = film.crop_size = Vec2i(0);
  }
  const Vec2i cropped = film.crop_size == Vec2i(0) ? film.size : film.crop_size;
  view.camera->set_raster(
      {film.size, film.crop_offset, cropped, filter_border(*film.filter) * 1.0});
  return view;
}

}  // namespace mlt
