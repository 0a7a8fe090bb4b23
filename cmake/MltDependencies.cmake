# Every library we build on, with one error that says what to install.
file(STRINGS "${PROJECT_SOURCE_DIR}/cmake/apt-packages.txt" apt_packages)
file(STRINGS "${PROJECT_SOURCE_DIR}/cmake/apt-packages-test.txt" apt_test_packages)
list(JOIN apt_packages " " apt_line)
if(PYMLT_TESTS)
  list(JOIN apt_test_packages " " apt_test_line)
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS cmake/apt-packages.txt
                                       cmake/apt-packages-test.txt)

function(mlt_missing what)
  message(FATAL_ERROR "${what} was not found. On Debian and Ubuntu this installs everything:\n"
                      "  apt-get install ${apt_line} ${apt_test_line}\n")
endfunction()

# mlt_require(<what> <found>): stops with the apt line unless the variable <found> is true.
macro(mlt_require what found)
  if(NOT ${found})
    mlt_missing("${what}")
  endif()
endmacro()

# Embree 3 and 4 have the same target and, but for a few lines, the same source.
find_package(embree 4 CONFIG QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.12 CONFIG QUIET)
endif()
mlt_require("Embree (version 4, or 3.12 and later)" embree_FOUND)
string(REGEX MATCH "^[0-9]+" MLT_EMBREE_MAJOR "${embree_VERSION}")
message(STATUS "Embree ${embree_VERSION}")

find_package(fmt CONFIG QUIET)
mlt_require("fmt" fmt_FOUND)
find_package(glm CONFIG QUIET)
mlt_require("GLM" glm_FOUND)
find_package(pugixml CONFIG QUIET)
mlt_require("pugixml" pugixml_FOUND)
set(CMAKE_MESSAGE_LOG_LEVEL NOTICE) # Debian's Imath tells at length that PyImath is not there
find_package(OpenEXR CONFIG QUIET)
unset(CMAKE_MESSAGE_LOG_LEVEL)
mlt_require("OpenEXR" OpenEXR_FOUND)
find_package(ZLIB QUIET)
mlt_require("zlib" ZLIB_FOUND)
find_package(JPEG QUIET)
mlt_require("libjpeg-turbo" JPEG_FOUND)
find_package(PNG QUIET)
mlt_require("libpng" PNG_FOUND)
find_package(CLI11 CONFIG QUIET)
mlt_require("CLI11" CLI11_FOUND)
find_path(MLT_STB_DIR stb/stb_image.h)
mlt_require("stb" MLT_STB_DIR)
find_package(Threads REQUIRED)
# Optional: without it, the volume `nanovdb` says what to install.
find_path(MLT_NANOVDB_DIR nanovdb/util/IO.h)

if(PYMLT_TESTS)
  find_package(GTest QUIET)
  mlt_require("GoogleTest" GTest_FOUND)
endif()

if(PYMLT_PYTHON)
  set(PYBIND11_FINDPYTHON ON)
  find_package(Python 3.11 COMPONENTS Interpreter Development.Module)
  mlt_require("Python 3.11 or later, with its headers," Python_FOUND)
  if(NOT SKBUILD)
    execute_process(
      COMMAND "${Python_EXECUTABLE}" -m pybind11 --cmakedir
      OUTPUT_VARIABLE pybind11_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  find_package(pybind11 3.1 CONFIG QUIET)
  if(NOT pybind11_FOUND)
    message(FATAL_ERROR "pybind11 3.1 was not found by ${Python_EXECUTABLE}: "
                        "`pip install 'pybind11>=3.1'`, or configure with -DPYMLT_PYTHON=OFF.")
  endif()
endif()
