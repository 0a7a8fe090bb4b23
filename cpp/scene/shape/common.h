// Functions of the shape plug-ins.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/registry.h"
#include "scene/mesh/mesh_data.h"

namespace mlt {

/// The schema of a shape: `parameters`, and those that every shape has.
Schema shape_schema(const std::string& name, const std::string& doc,
                    std::vector<Parameter> parameters);

Parameter filename_parameter(const char* doc);
/// `face_normals` and `max_smooth_angle`, which mesh_from_data reads.
std::vector<Parameter> normals_parameters();

/// A Mesh from checked buffers. Without vertex normals the surface is smooth, as in Mitsuba, unless
/// `flat` or the parameter `face_normals` says otherwise.
ObjectPtr mesh_from_data(Params& params, MeshData data, bool flat = false);
/// A Mesh from the buffers of the file `filename`, which are checked.
ObjectPtr mesh_from_file(Params& params, MeshData data, bool flat = false);

using MeshReader = MeshData (*)(std::string_view bytes, const std::string& name, Params& params);
/// A mesh from a file that `read` understands; `flip_tex_coords` is the default of the parameter.
Plugin mesh_file_plugin(const char* name, const char* doc, const char* filename_doc,
                        bool flip_tex_coords, MeshReader read,
                        const std::vector<Parameter>& own = {});

/// A mesh without vertex normals whose triangles turn counter-clockwise seen from outside; they do
/// so too if `to_world` mirrors it.
Plugin flat_shape_plugin(const char* name, const char* doc, MeshData (*make)());

}  // namespace mlt
