# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# velum_add_plugin(<kind> <name> [FOLDER <folder>] [LINK <target>...] [NO_TEST])
#
# Makes the plugin <kind>.<name> of a folder (the current one) by its convention: <name>.cpp (and
# other *.cpp beside it), <name>_test.cpp, README.md, example.toml. The plugin becomes
# <build>/plugins/<kind>/<name>.so, its example <build>/plugins/<kind>/<name>.toml; where Catch2 is
# found ctest runs its test as <kind>.<name>. Installed with the prefix of Velum it is found by itself,
# else by VELUM_PLUGIN_PATH=<build>/plugins.
include_guard(GLOBAL)
include(GNUInstallDirs)

function(velum_add_plugin kind name)
  cmake_parse_arguments(PARSE_ARGV 2 arg "NO_TEST" "FOLDER" "LINK")
  set(folder ${CMAKE_CURRENT_SOURCE_DIR})
  if(arg_FOLDER)
    set(folder ${arg_FOLDER})
  endif()
  foreach(file ${name}.cpp ${name}_test.cpp README.md example.toml)
    if(NOT EXISTS ${folder}/${file})
      message(FATAL_ERROR "plugin ${kind}.${name}: ${folder}/${file} is missing")
    endif()
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")

  set(target velum_${kind}_${name})
  set(place ${CMAKE_INSTALL_LIBDIR}/velum/plugins/${kind})
  add_library(${target} MODULE ${sources})
  target_compile_definitions(${target} PRIVATE VELUM_STAGE_ID="${kind}.${name}")
  target_compile_options(${target} PRIVATE
    -fvisibility=hidden -fvisibility-inlines-hidden -ffp-contract=off)
  target_link_libraries(${target} PRIVATE Velum::velum ${arg_LINK})
  target_link_options(${target} PRIVATE -Wl,-z,defs)
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/plugins/${kind} INSTALL_RPATH $ORIGIN/../../..)
  configure_file(${folder}/example.toml ${PROJECT_BINARY_DIR}/plugins/${kind}/${name}.toml COPYONLY)
  install(TARGETS ${target} LIBRARY DESTINATION ${place})
  install(FILES ${folder}/example.toml RENAME ${name}.toml DESTINATION ${place})
  if(NOT arg_NO_TEST)
    velum_add_plugin_test(${kind} ${name} ${folder} ${target})
  endif()
endfunction()

function(velum_add_plugin_test kind name folder plugin)
  find_package(Catch2 2.13 QUIET)
  if(NOT Catch2_FOUND)
    message(STATUS "plugin ${kind}.${name}: no test without Catch2 2.13 (Debian: catch2)")
    return()
  endif()
  set(target test_${kind}_${name})
  add_executable(${target} ${folder}/${name}_test.cpp
    ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/velum_test_main.cpp)
  target_link_libraries(${target} PRIVATE Velum::velum Catch2::Catch2)
  add_dependencies(${target} ${plugin})
  add_test(NAME ${kind}.${name} COMMAND ${target})
  set_tests_properties(${kind}.${name} PROPERTIES TIMEOUT 300
    ENVIRONMENT "VELUM_PLUGIN_PATH=${PROJECT_BINARY_DIR}/plugins")
endfunction()
