# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# velum::pcl_<component>: PCL's compiled libraries one by one. PCL's own CMake configuration brings
# VTK, Qt and OpenNI along with every component.
include_guard(GLOBAL)
find_package(Eigen3 REQUIRED NO_MODULE GLOBAL)
find_package(Boost REQUIRED GLOBAL)
find_path(VELUM_PCL_INCLUDE pcl/pcl_config.h PATH_SUFFIXES pcl-1.13 pcl-1.12 pcl-1.14 pcl-1.15)
foreach(component common kdtree octree search sample_consensus filters features registration
        segmentation surface)
  find_library(VELUM_PCL_${component} pcl_${component})
  if(NOT VELUM_PCL_INCLUDE OR NOT VELUM_PCL_${component})
    message(FATAL_ERROR "PCL's ${component} is missing: install libpcl-dev (tools/setup.sh build)")
  endif()
  add_library(velum_pcl_${component} INTERFACE)
  add_library(velum::pcl_${component} ALIAS velum_pcl_${component})
  target_include_directories(velum_pcl_${component} SYSTEM INTERFACE ${VELUM_PCL_INCLUDE})
  target_link_libraries(velum_pcl_${component} INTERFACE ${VELUM_PCL_${component}} Eigen3::Eigen
    Boost::headers)
endforeach()
