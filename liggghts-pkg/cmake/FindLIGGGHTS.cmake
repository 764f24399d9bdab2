# SPDX-License-Identifier: GPL-2.0-or-later
# Finds LIGGGHTS 3.8 as a library with headers and defines the imported target LIGGGHTS::liggghts.
# Input: LIGGGHTS_ROOT or CMAKE_PREFIX_PATH.  Output: LIGGGHTS_LIBRARY, LIGGGHTS_INCLUDE_DIR, LIGGGHTS_VERSION.
#
# The headers must be read with the macros the library was compiled with, or structs silently differ in size.
# No header says which these were, so the symbols of the library are asked.
include(FindPackageHandleStandardArgs)
find_package(MPI REQUIRED COMPONENTS C)

find_path(LIGGGHTS_INCLUDE_DIR granular_wall.h PATH_SUFFIXES liggghts)
find_library(LIGGGHTS_LIBRARY liggghts)
mark_as_advanced(LIGGGHTS_INCLUDE_DIR LIGGGHTS_LIBRARY)
if(LIGGGHTS_LIBRARY)
  file(REAL_PATH ${LIGGGHTS_LIBRARY} real_library)
  if(real_library MATCHES "\\.so\\.([0-9.]+)$")
    set(LIGGGHTS_VERSION ${CMAKE_MATCH_1})
  endif()
endif()
find_package_handle_standard_args(LIGGGHTS
  REQUIRED_VARS LIGGGHTS_LIBRARY LIGGGHTS_INCLUDE_DIR
  VERSION_VAR LIGGGHTS_VERSION
  REASON_FAILURE_MESSAGE "Debian and Ubuntu have it in the package libliggghts-dev.")

# Fails unless the library defines `symbol`; `meaning` says what its absence means.
function(liggghts_require symbols symbol meaning)
  string(FIND "${symbols}" " ${symbol}\n" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "${LIGGGHTS_LIBRARY} does not define ${symbol}: ${meaning}")
  endif()
endfunction()

function(liggghts_check_library)
  execute_process(COMMAND ${CMAKE_NM} -D -C --defined-only ${LIGGGHTS_LIBRARY}
    OUTPUT_VARIABLE symbols RESULT_VARIABLE failed ERROR_VARIABLE complaint)
  if(failed)
    message(FATAL_ERROR "Cannot list the symbols of ${LIGGGHTS_LIBRARY} with ${CMAKE_NM}: ${complaint}")
  endif()
  liggghts_require("${symbols}" "LAMMPS_NS::LAMMPS::create()"
    "this is no LIGGGHTS library, or its symbols are hidden; fix styles cannot be added to it.")
  foreach(factory Walls PairStyles ContactModels)
    liggghts_require("${symbols}" "LIGGGHTS::${factory}::Factory::instance()"
      "contact models cannot be added; LIGGGHTS-PUBLIC 3.8 is expected.")
  endforeach()
  liggghts_require("${symbols}" "LAMMPS_NS::Modify::addstep_compute(long)"
    "it was built with other integer sizes than the default (LAMMPS_SMALLBIG), which our build assumes.")
  if(symbols MATCHES "Superquadric::")
    message(FATAL_ERROR "${LIGGGHTS_LIBRARY} was built with SUPERQUADRIC_ACTIVE_FLAG, which changes the layout of "
      "FixWallGran and of the contact data; a LIGGGHTS for spheres (the default build) is expected.")
  endif()
endfunction()

# LIGGGHTS' contact headers include lists of all models that its own build writes but does not install:
# style_<kind>_model.h has one #include per header with a <KIND>_MODEL(...) entry.
function(liggghts_write_model_lists folder)
  foreach(kind surface normal tangential cohesion rolling)
    string(TOUPPER ${kind} KIND)
    file(GLOB headers ${LIGGGHTS_INCLUDE_DIR}/${kind}_model_*.h)
    set(list "")
    foreach(header ${headers})
      file(STRINGS ${header} entry REGEX "^${KIND}_MODEL\\(")
      if(entry)
        get_filename_component(name ${header} NAME)
        string(APPEND list "#include \"${name}\"\n")
      endif()
    endforeach()
    if(NOT list)
      message(FATAL_ERROR "${LIGGGHTS_INCLUDE_DIR} has no header with a ${KIND}_MODEL(...) entry; the headers of "
        "LIGGGHTS-PUBLIC 3.8 are expected.")
    endif()
    file(CONFIGURE OUTPUT ${folder}/style_${kind}_model.h CONTENT "${list}")
  endforeach()
endfunction()

if(LIGGGHTS_FOUND AND NOT TARGET LIGGGHTS::liggghts)
  liggghts_check_library()
  set(model_lists ${CMAKE_CURRENT_BINARY_DIR}/liggghts-model-lists)
  liggghts_write_model_lists(${model_lists})

  add_library(LIGGGHTS::liggghts SHARED IMPORTED GLOBAL)
  set_target_properties(LIGGGHTS::liggghts PROPERTIES
    IMPORTED_LOCATION ${LIGGGHTS_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${LIGGGHTS_INCLUDE_DIR};${model_lists}"   # imported: they count as SYSTEM
    INTERFACE_COMPILE_DEFINITIONS "OMPI_SKIP_MPICXX;MPICH_SKIP_MPICXX"       # no C++ bindings of MPI
    INTERFACE_LINK_LIBRARIES MPI::MPI_C)
endif()
