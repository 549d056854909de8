# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# velum::openmesh: OpenMesh with its tools. Its own CMake configuration makes targets that are not
# global.
include_guard(GLOBAL)
find_path(VELUM_OPENMESH_INCLUDE OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh)
find_library(VELUM_OPENMESH_CORE OpenMeshCore)
find_library(VELUM_OPENMESH_TOOLS OpenMeshTools)
if(NOT VELUM_OPENMESH_INCLUDE OR NOT VELUM_OPENMESH_CORE OR NOT VELUM_OPENMESH_TOOLS)
  message(FATAL_ERROR "OpenMesh is missing: install libopenmesh-dev (tools/setup.sh build)")
endif()
add_library(velum_openmesh INTERFACE)
add_library(velum::openmesh ALIAS velum_openmesh)
target_include_directories(velum_openmesh SYSTEM INTERFACE ${VELUM_OPENMESH_INCLUDE})
target_link_libraries(velum_openmesh INTERFACE ${VELUM_OPENMESH_TOOLS} ${VELUM_OPENMESH_CORE})
