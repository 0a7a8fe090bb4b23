# One GoogleTest binary per folder of tests/cpp, made of the test_*.cpp in and below it. Every other
# source there is a harness that the tests share, and so are the examples of the documentation, which
# the tests take like plug-ins of the library. Tests run in the root of the repository.
#
# A test is long when its suite's name starts with "Long"; ctest gives it the label `long`.
include(GoogleTest)

file(GLOB_RECURSE support_files CONFIGURE_DEPENDS tests/cpp/*.cpp tests/cpp/*.h)
list(FILTER support_files EXCLUDE REGEX "/test_[^/]*\\.cpp$")
file(GLOB example_files CONFIGURE_DEPENDS docs/examples/*.cpp)
list(APPEND support_files ${example_files})
add_library(mlt_test_support INTERFACE)
# Tests write the files that the library reads.
set(test_libraries mlt OpenEXR::OpenEXR pugixml::pugixml ZLIB::ZLIB GTest::gmock GTest::gtest)
if("${support_files}" MATCHES "\\.cpp")
  add_library(mlt_test_harness STATIC ${support_files})
  target_include_directories(mlt_test_harness PUBLIC tests/cpp)
  target_link_libraries(mlt_test_harness PUBLIC ${test_libraries})
  target_link_libraries(mlt_test_support INTERFACE mlt_test_harness)
endif()
target_include_directories(mlt_test_support INTERFACE tests/cpp)
target_link_libraries(mlt_test_support INTERFACE ${test_libraries} GTest::gtest_main)

set(long_suites "Long*:*/Long*")
file(GLOB_RECURSE test_files CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/tests/cpp"
     tests/cpp/test_*.cpp)
foreach(file IN LISTS test_files)
  string(REGEX MATCH "^[^/]+" floor "${file}")
  set(target test_${floor})
  if(NOT TARGET ${target})
    add_executable(${target})
    target_link_libraries(${target} PRIVATE mlt_test_support)
    gtest_discover_tests(
      ${target}
      TEST_FILTER "-${long_suites}"
      TEST_PREFIX "${floor}."
      WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
      DISCOVERY_MODE PRE_TEST
      DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT 300)
    gtest_discover_tests(
      ${target}
      TEST_FILTER "${long_suites}"
      TEST_PREFIX "${floor}."
      TEST_LIST ${target}_long
      WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
      DISCOVERY_MODE PRE_TEST
      DISCOVERY_TIMEOUT 60
      PROPERTIES LABELS long TIMEOUT 3600)
  endif()
  target_sources(${target} PRIVATE "${PROJECT_SOURCE_DIR}/tests/cpp/${file}")
endforeach()

# Eight lanes must compile, too, where no register is wide enough for them: wheels are built for all
# processors.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_library(narrow_lanes OBJECT
    "${PROJECT_SOURCE_DIR}/cpp/scene/bsdf/phong.cpp"
    "${PROJECT_SOURCE_DIR}/cpp/scene/bsdf/principled.cpp"
    "${PROJECT_SOURCE_DIR}/cpp/scene/emitter/environment_map.cpp")
  target_compile_options(narrow_lanes PRIVATE -march=x86-64)
  target_link_libraries(narrow_lanes PRIVATE mlt)
endif()
