# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Compiler settings that every target of this project shares: the target velum::options.
include_guard(GLOBAL)

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Where the source folder lies does not matter to ccache, so that presets and clones share results.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_NOHASHDIR=1
      CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${CCACHE})
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)

add_library(velum_options INTERFACE)
add_library(velum::options ALIAS velum_options)
# No fused multiply-add and no -march=native: the same bytes on every machine.
target_compile_options(velum_options INTERFACE
  -Wall -Wextra -Wconversion -Wshadow -Werror -ffp-contract=off
  # Says wrong things of `"text" + std::string` in GCC 12 (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
find_program(MOLD mold)
if(MOLD AND NOT VELUM_SANITIZE)
  target_link_options(velum_options INTERFACE -fuse-ld=mold)
endif()
if(VELUM_SANITIZE)
  target_compile_options(velum_options INTERFACE
    -fsanitize=${VELUM_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  target_link_options(velum_options INTERFACE -fsanitize=${VELUM_SANITIZE})
  target_compile_definitions(velum_options INTERFACE VELUM_SANITIZED)
  # GCC's sanitizers make it see uninitialised values in Catch's and the standard library's code;
  # clang leaves the sanitizer's own symbols of a shared object to the program.
  target_compile_options(velum_options INTERFACE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(velum_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:LINKER:-z,undefs>)
  target_compile_options(velum_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${CMAKE_CURRENT_LIST_DIR}/ubsan_ignore.txt>)
endif()
if(VELUM_FUZZ)
  target_compile_options(velum_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
