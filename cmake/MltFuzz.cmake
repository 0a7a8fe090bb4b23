# Each tests/fuzz/fuzz_<name>.cpp becomes fuzz_<name>, which clang's libFuzzer runs (PYMLT_FUZZ), and
# replay_<name>, by which the tests read again what lies in the repository: the corpus, and whatever
# has once made a reader fail.
set(fuzz_folder "${PROJECT_SOURCE_DIR}/tests/fuzz")
file(GLOB fuzz_files CONFIGURE_DEPENDS "${fuzz_folder}/fuzz_*.cpp")

function(mlt_fuzz_program program)
  add_executable(${program} ${ARGN})
  target_link_libraries(${program} PRIVATE mlt ZLIB::ZLIB)
endfunction()

foreach(file IN LISTS fuzz_files)
  get_filename_component(target "${file}" NAME_WE)
  string(REPLACE "fuzz_" "" name "${target}")
  if(PYMLT_FUZZ)
    mlt_fuzz_program(${target} "${file}" "${fuzz_folder}/libfuzzer.cpp")
    target_link_options(${target} PRIVATE -fsanitize=fuzzer)
  endif()
  if(PYMLT_TESTS)
    mlt_fuzz_program(replay_${name} "${file}" "${fuzz_folder}/replay.cpp")
    add_test(
      NAME fuzz.${name}
      COMMAND replay_${name} tests/fuzz/corpus/${name} tests/fuzz/regressions/${name}
      WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
    set_tests_properties(fuzz.${name} PROPERTIES TIMEOUT 120)
  endif()
endforeach()
