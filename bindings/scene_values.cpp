// The values of parameters as Python objects.
#include "scene_dict.h"

#include <pybind11/stl.h>

namespace mlt::python {
namespace {

struct ToPython {
  py::object operator()(std::monostate) const { return py::none(); }
  py::object operator()(const ObjectPtr&) const { return py::none(); }
  py::object operator()(const Matrix& m) const {
    py::list rows;
    for (size_t i = 0; i < 16; i += 4)
      rows.append(py::make_tuple(m[i], m[i + 1], m[i + 2], m[i + 3]));
    return rows;
  }
  py::object operator()(const Animation& animation) const {
    py::dict keys;
    for (const Keyframe& key : animation) keys[py::float_(key.time)] = (*this)(key.transform);
    return keys;
  }
  py::object operator()(const Buffer& buffer) const { return py::bytes(buffer.bytes()); }
  py::object operator()(const Triple& t) const { return py::make_tuple(t[0], t[1], t[2]); }
  template <class T>
  py::object operator()(const T& value) const {
    return py::cast(value);
  }
};

}  // namespace

py::object to_python(const Value& value) { return std::visit(ToPython{}, value); }

}  // namespace mlt::python
