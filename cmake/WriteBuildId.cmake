# Writes a header with an identity of the library: a hash of its sources, its compiler and its flags.
# Two programs of one build share it, and another build has another. Called when a source changes:
#   cmake -DSOURCES=<folder> -DTOOLS=<text> -DOUTPUT=<header> -P WriteBuildId.cmake
file(GLOB_RECURSE files RELATIVE "${SOURCES}" "${SOURCES}/*.h" "${SOURCES}/*.cpp" "${SOURCES}/*.inc")
list(FILTER files EXCLUDE REGEX "^app/") # the command line does not change pixels
list(SORT files)
set(all "${TOOLS}")
foreach(file IN LISTS files)
  file(SHA256 "${SOURCES}/${file}" hash)
  string(APPEND all "\n${file} ${hash}")
endforeach()
string(SHA256 id "${all}")
string(SUBSTRING "${id}" 0 16 id)
file(WRITE "${OUTPUT}" "// Made by cmake/WriteBuildId.cmake.\n#pragma once\n\n#define MLT_BUILD_ID \"${id}\"\n")
