// Texts that need not be UTF-8, such as file names: bytes in C++, in Python the result of
// os.fsdecode.
#pragma once

#include "base/error.h"

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

namespace mlt::python {

struct Text {
  std::string bytes;
  operator const std::string&() const { return bytes; }
};

/// The bytes of a str, of bytes or of a path. Throws UsageError for a str that cannot be encoded.
inline std::string bytes_of(const pybind11::handle& text) {
  PyObject* found = nullptr;
  if (!PyUnicode_FSConverter(text.ptr(), &found)) {
    PyErr_Clear();
    throw UsageError("a text has a null character or a lone surrogate, which no encoding has");
  }
  const auto bytes = pybind11::reinterpret_steal<pybind11::bytes>(found);
  return bytes;
}

inline pybind11::object to_str(const std::string& bytes) {
  return pybind11::reinterpret_steal<pybind11::object>(
      PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size())));
}

inline pybind11::list to_list(const std::vector<std::string>& texts) {
  pybind11::list list;
  for (const std::string& text : texts) list.append(to_str(text));
  return list;
}

}  // namespace mlt::python

namespace pybind11::detail {

template <>
struct type_caster<mlt::python::Text> {
  PYBIND11_TYPE_CASTER(mlt::python::Text, const_name("str"));

  bool load(handle source, bool) {
    if (!PyUnicode_Check(source.ptr()) && !PyBytes_Check(source.ptr()) &&
        !hasattr(source, "__fspath__"))
      return false;
    value.bytes = mlt::python::bytes_of(source);
    return true;
  }
  static handle cast(const mlt::python::Text& text, return_value_policy, handle) {
    return mlt::python::to_str(text.bytes).release();
  }
};

}  // namespace pybind11::detail
