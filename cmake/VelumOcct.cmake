# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# velum::occt: OpenCASCADE's libraries that read and write STEP and IGES. Its own CMake
# configuration names visualisation libraries, which need a window system.
include_guard(GLOBAL)
find_path(VELUM_OCCT_INCLUDE STEPControl_Writer.hxx PATH_SUFFIXES opencascade)
add_library(velum_occt INTERFACE)
add_library(velum::occt ALIAS velum_occt)
target_include_directories(velum_occt SYSTEM INTERFACE ${VELUM_OCCT_INCLUDE})
foreach(component TKernel TKMath TKG2d TKG3d TKGeomBase TKGeomAlgo TKBRep TKTopAlgo TKShHealing
        TKXSBase TKSTEPBase TKSTEP TKIGES)
  find_library(VELUM_OCCT_${component} ${component})
  if(NOT VELUM_OCCT_INCLUDE OR NOT VELUM_OCCT_${component})
    message(FATAL_ERROR "OpenCASCADE's ${component} is missing: install libocct-data-exchange-dev "
      "and libocct-modeling-algorithms-dev (tools/setup.sh build)")
  endif()
  target_link_libraries(velum_occt INTERFACE ${VELUM_OCCT_${component}})
endforeach()
