// What the shape plug-ins share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/registry.h"
#include "scene/mesh_data.h"

namespace mlt {

/// The schema of a shape: `parameters`, and those that every shape has.
Schema shape_schema(const std::string& name, const std::string& doc,
                    std::vector<Parameter> parameters);

// Parameters that some shapes have.
Parameter filename_parameter(const std::string& doc);
Parameter face_normals_parameter();
Parameter flip_tex_coords_parameter(bool default_value);

/// The bytes of the file that `filename` names. Throws FileError.
std::string read_file(Params& params);

/// v -> 1 - v, if `flip_tex_coords` is set.
void flip_tex_coords(Params& params, MeshData& data);

/// A Mesh from what a file holds. Without vertex normals in the file the surface is smooth, as in
/// Mitsuba, unless `flat` or the parameter `face_normals` says otherwise.
ObjectPtr mesh_from_file(Params& params, MeshData data, bool flat = false);

/// A flat Mesh whose triangles turn counter-clockwise seen from outside; it stays so if `to_world`
/// mirrors it.
ObjectPtr flat_mesh(Params& params, MeshData data);

}  // namespace mlt
