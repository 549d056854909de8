# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# velum_plugin(<kind> <name> [LINK <target>...])
#
# The plugin of the folder <name>/ below the current one, as velum_add_plugin makes it, with this
# project's warnings and test settings.
include_guard(GLOBAL)
include(VelumAddPlugin)

function(velum_plugin kind name)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "LINK")
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${name})
  velum_add_plugin(${kind} ${name} FOLDER ${folder} LINK velum::options ${arg_LINK} NO_TEST)
  if(VELUM_TESTS)
    velum_test(${kind}.${name} ${folder}/${name}_test.cpp LINK ${arg_LINK}
      DEPENDS velum_${kind}_${name})
  endif()
endfunction()
