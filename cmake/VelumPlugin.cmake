# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# velum_plugin(<kind> <name> [LINK <target>...])
#
# Makes the plugin <kind>.<name> of the folder <name>/ below the current one, by its convention:
# <name>.cpp (and other *.cpp beside it), <name>_test.cpp, README.md, example.toml. The plugin
# becomes <build>/plugins/<kind>/<name>.so, its example <build>/plugins/<kind>/<name>.toml.
include_guard(GLOBAL)

function(velum_plugin kind name)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "LINK")
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${name})
  foreach(file ${name}.cpp ${name}_test.cpp README.md example.toml)
    if(NOT EXISTS ${folder}/${file})
      message(FATAL_ERROR "plugin ${kind}.${name}: ${folder}/${file} is missing")
    endif()
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")

  set(target velum_${kind}_${name})
  add_library(${target} MODULE ${sources})
  target_compile_definitions(${target} PRIVATE VELUM_STAGE_ID="${kind}.${name}")
  target_compile_options(${target} PRIVATE -fvisibility=hidden -fvisibility-inlines-hidden)
  target_link_libraries(${target} PRIVATE Velum::velum velum::options ${arg_LINK})
  target_link_options(${target} PRIVATE -Wl,-z,defs)
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/plugins/${kind})
  configure_file(${folder}/example.toml ${PROJECT_BINARY_DIR}/plugins/${kind}/${name}.toml COPYONLY)
  install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/velum/plugins/${kind})
  install(FILES ${folder}/example.toml RENAME ${name}.toml
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/velum/plugins/${kind})
  if(VELUM_TESTS)
    velum_test(${kind}.${name} ${folder}/${name}_test.cpp LINK ${arg_LINK} DEPENDS ${target})
  endif()
endfunction()
