// Image files and numpy arrays.
#include "bindings.h"
#include "text.h"

#include "base/atomic_file.h"
#include "image/exposure.h"
#include "image/image_io.h"
#include "job/output.h"

#include <pybind11/stl.h>

#include <array>
#include <climits>
#include <cstring>
#include <map>
#include <memory>

namespace mlt::python {
namespace {

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;

Image to_image(const Floats& array) {
  if (array.ndim() != 3 && array.ndim() != 2)
    throw UsageError("an image should have the shape (height, width, channels) or (height, width)");
  const auto extent = [&](int axis) {
    return static_cast<int>(std::min<py::ssize_t>(array.shape(axis), INT_MAX));
  };
  Image image(extent(1), extent(0), array.ndim() == 3 ? extent(2) : 1);
  std::memcpy(image.data.data(), array.data(), image.data.size() * sizeof(float));
  return image;
}

using Layers = std::map<std::string, Floats>;
using Texts = std::map<std::string, std::string>;

/// Calls `function` (write_render or save_render) for these arrays, and returns its result.
template <class Function>
auto with_images(const Function& function, const std::string& path, const Floats& array,
                 const Layers& layers, const Texts& metadata, bool half, double exposure) {
  RenderedImage render{to_image(array), {}};
  for (const auto& [name, pixels] : layers) render.layers.push_back({name, to_image(pixels)});
  const WriteOptions options{half, Metadata(metadata.begin(), metadata.end()), exposure};
  const ReleasedGil release;
  return function(path, render, options);
}

void write(const Text& path, const Floats& array, const Layers& layers, const Texts& metadata,
           bool half, double exposure) {
  with_images(write_render, path, array, layers, metadata, half, exposure);
}

py::tuple to_tuple(const Saved& saved) {
  return py::make_tuple(to_str(saved.path), to_str(saved.problem));
}

py::tuple save(const Text& path, const Floats& array, const Layers& layers, const Texts& metadata,
               bool half, double exposure) {
  return to_tuple(with_images(save_render, path, array, layers, metadata, half, exposure));
}

py::array_t<float> read(const Text& path, const std::string& layer) {
  Image image;
  {
    const ReleasedGil release;
    image = linear_image(read_image(path, layer));
  }
  return to_array(std::move(image));
}

py::array_t<float> decode(const std::string& bytes, const std::string& name) {
  return to_array(without_gil([&] { return linear_image(read_image_memory(bytes, name)); }));
}

py::dict metadata(const Text& path) { return py::cast(read_exr_metadata(path)); }

}  // namespace

py::array_t<float> to_array(Image image) {
  auto owned = std::make_unique<Image>(std::move(image));
  const Image& kept = *owned;
  py::capsule owner(owned.get(), [](void* pointer) { delete static_cast<Image*>(pointer); });
  owned.release();
  const std::array<py::ssize_t, 3> shape{kept.height, kept.width, kept.channels};
  return py::array_t<float>(shape, kept.data.data(), owner);
}

void bind_image(py::module_& m) {
  m.def("read_image", &read, py::arg("path"), py::arg("layer") = "");
  m.def("decode_image", &decode, py::arg("bytes"), py::arg("name"),
        "The pixels of an image file's bytes, in linear light; errors call it by the name.");
  m.def(
      "fitting_exposure",
      [](const Floats& array) {
        const Image image = to_image(array);
        const ReleasedGil release;
        return fitting_exposure(image);
      },
      py::arg("image"), "The stops that suit a linear image.");
  m.def(
      "encode_jpeg",
      [](const Floats& array, double exposure) {
        const Image image = to_image(array);
        return py::bytes(without_gil([&] { return jpeg_of(image, exposure); }));
      },
      py::arg("image"), py::arg("exposure") = 0.0,
      "A JPEG file of linear pixels: 8 bits, sRGB, full resolution of the colours.\n\n"
      "Raises UsageError for an image that JPEG cannot hold, such as one with alpha.");
  m.def("is_known_image", [](const Text& path) { return is_known_image(path); }, py::arg("path"));
  m.def(
      "read_file",
      [](const Text& path, uint64_t largest) { return py::bytes(read_file(path, largest)); },
      py::arg("path"), py::arg("largest"), "The bytes of a regular file.");
  m.def("read_metadata", &metadata, py::arg("path"));
  m.def("write_image", &write, py::arg("path"), py::arg("image"), py::arg("layers"),
        py::arg("metadata"), py::arg("half"), py::arg("exposure"));
  m.def("save_image", &save, py::arg("path"), py::arg("image"), py::arg("layers"),
        py::arg("metadata"), py::arg("half"), py::arg("exposure"),
        "A failed write is tried again elsewhere. Returns (path, problem): where the image is, or "
        "\"\"; and why it is not where it was asked for, or \"\".");
  m.def(
      "save_text",
      [](const Text& path, const std::string& text) { return to_tuple(save_text(path, text)); },
      py::arg("path"), py::arg("text"), "The same for a file of these bytes.");
  m.def(
      "replace_file", [](const Text& path, const std::string& bytes) { write_file(path, bytes); },
      py::arg("path"), py::arg("bytes"), NoGil(), "At once or not at all. Raises FileError.");
  m.def(
      "alpha_problem", [](const Text& path) { return alpha_problem(path); }, py::arg("path"),
      "Why a file of this name will have no alpha, or \"\".");
  m.def("check_image_writable", [](const Text& path) { check_writable(path); }, py::arg("path"));
  m.def(
      "check_file_writable", [](const Text& path) { check_file_writable(path); }, py::arg("path"));
}

}  // namespace mlt::python
