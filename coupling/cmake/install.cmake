# SPDX-License-Identifier: GPL-2.0-or-later
# Headers, libraries and the package configuration for consumers of the solver and the coupling library.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/liggghts-nurbs)
set(header_dir ${CMAKE_INSTALL_INCLUDEDIR}/liggghts-nurbs)

install(TARGETS nurbs nurbs_search nurbs_brep geometry_io geometry_io_splines nurbs_vtk structure iga_io iga_ranks iga_parallel coupling coupling_contact coupling_iga coupling_plugin structure_plugin project_warnings
  EXPORT liggghts-nurbs-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT liggghts-nurbs-targets NAMESPACE liggghts_nurbs:: DESTINATION ${package_dir})
foreach(folder iga-solver/nurbs iga-solver/search iga-solver/brep iga-solver/geometry_io iga-solver/vtk iga-solver/structure iga-solver/parallel iga-solver/io coupling)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${header_dir} FILES_MATCHING PATTERN "*.h")
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/liggghts-nurbs-config.cmake.in
  ${PROJECT_BINARY_DIR}/liggghts-nurbs-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/liggghts-nurbs-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/liggghts-nurbs-config.cmake
              ${PROJECT_BINARY_DIR}/liggghts-nurbs-config-version.cmake DESTINATION ${package_dir})

# The same for LIGGGHTS' own Makefiles (liggghts-pkg/Install.sh).
set(HDF5_PREFER_PARALLEL ON)
find_package(HDF5 REQUIRED COMPONENTS C)
get_target_property(eigen_folders Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
list(TRANSFORM eigen_folders PREPEND -I)
list(JOIN eigen_folders " " eigen_flags)
list(JOIN HDF5_C_LIBRARIES " " hdf5_files)
configure_file(${PROJECT_SOURCE_DIR}/liggghts-pkg/Makefile.nurbs.in ${PROJECT_BINARY_DIR}/Makefile.nurbs @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/Makefile.nurbs DESTINATION ${CMAKE_INSTALL_DATADIR}/liggghts-nurbs)
