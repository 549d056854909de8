# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# velum_test(<name> <source>... [LINK <target>...] [DEPENDS <target>...] [LABELS <label>...])
#
# A Catch2 program <build>/tests/<name> that ctest runs as <name>, with the plugins of this build.
include_guard(GLOBAL)
find_package(Catch2 2.13 REQUIRED)

add_library(velum_test_main STATIC ${CMAKE_CURRENT_LIST_DIR}/../tests/main.cpp)
target_link_libraries(velum_test_main PUBLIC Catch2::Catch2 velum::options)

# What is tested is optimised; the test itself builds faster without.
function(velum_test_options target)
  if(VELUM_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE -O1
      # It errs about Eigen's types and about strings at -O1.
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow>)
  endif()
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${target} PRIVATE VELUM_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    VELUM_BINARY_DIR="${PROJECT_BINARY_DIR}")
endfunction()

# The headers of every test are compiled once: that is more than half of the time of a small one.
# A test whose libraries want other options reads them as they are.
set(CMAKE_PCH_WARN_INVALID OFF)
if(NOT VELUM_SANITIZE)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/test_headers.cpp CONTENT "int main() {}\n")
  add_executable(velum_test_headers ${PROJECT_BINARY_DIR}/test_headers.cpp)
  target_link_libraries(velum_test_headers PRIVATE velum_test_main Velum::velum velum::options)
  velum_test_options(velum_test_headers)
  target_precompile_headers(velum_test_headers PRIVATE <catch2/catch.hpp> <velum/stage.hpp>)
endif()

function(velum_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LINK;DEPENDS;LABELS")
  string(REPLACE "." "_" target test_${name})
  add_executable(${target} ${arg_UNPARSED_ARGUMENTS})
  set_target_properties(${target} PROPERTIES OUTPUT_NAME ${name}
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  target_link_libraries(${target} PRIVATE velum_test_main Velum::velum velum::options ${arg_LINK})
  velum_test_options(${target})
  if(TARGET velum_test_headers)
    target_precompile_headers(${target} REUSE_FROM velum_test_headers)
  endif()
  if(arg_DEPENDS)
    add_dependencies(${target} ${arg_DEPENDS})
  endif()
  add_test(NAME ${name} COMMAND ${target})
  if(VELUM_SANITIZE)
    set(limit 900)
  else()
    set(limit 300)
  endif()
  set_tests_properties(${name} PROPERTIES TIMEOUT ${limit} LABELS "${arg_LABELS}" ENVIRONMENT
    "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/cmake/lsan_ignore.txt;VELUM_PLUGIN_PATH=${PROJECT_BINARY_DIR}/plugins;XDG_CACHE_HOME=${PROJECT_BINARY_DIR}/test-cache;VELUM_SHARED=${PROJECT_SOURCE_DIR}/../shared")
endfunction()
