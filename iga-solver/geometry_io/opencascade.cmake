# SPDX-License-Identifier: GPL-2.0-or-later
# OpenCASCADE as the target `opencascade`, which reads STEP and IGES; Debian's own CMake package does not work.
option(LIGGGHTS_NURBS_STEP "Read STEP and IGES, where OpenCASCADE is found" ON)
set(opencascade_packages "libocct-data-exchange-dev libocct-ocaf-dev libocct-modeling-algorithms-dev libtbb-dev")

find_path(OpenCASCADE_INCLUDE_DIR STEPCAFControl_Reader.hxx PATH_SUFFIXES opencascade)
set(libraries)
foreach(name IN ITEMS
    TKXDESTEP TKXDEIGES TKXCAF TKVCAF TKCAF TKLCAF TKCDF TKSTEP TKSTEPAttr TKSTEP209 TKSTEPBase TKIGES TKXSBase TKShHealing
    TKTopAlgo TKGeomAlgo TKBRep TKGeomBase TKG3d TKG2d TKMath TKernel)
  find_library(OpenCASCADE_${name}_LIBRARY ${name})
  list(APPEND libraries ${OpenCASCADE_${name}_LIBRARY})
endforeach()

set(opencascade_found OFF)
if(NOT LIGGGHTS_NURBS_STEP)
  message(STATUS "STEP and IGES: left out (LIGGGHTS_NURBS_STEP is OFF)")
elseif(NOT OpenCASCADE_INCLUDE_DIR OR libraries MATCHES NOTFOUND)
  message(STATUS "STEP and IGES: left out, no OpenCASCADE (Debian: ${opencascade_packages})")
else()
  set(opencascade_found ON)
  add_library(opencascade INTERFACE)
  target_include_directories(opencascade SYSTEM INTERFACE ${OpenCASCADE_INCLUDE_DIR})
  target_link_libraries(opencascade INTERFACE ${libraries})
endif()
