# Installed: the program, the library, its public headers, a CMake package (find_package(raytube)), and in the layout of the sources, so
# that links hold, the documentation with example and cases.
include(CMakePackageConfigHelpers)
install(TARGETS raytube RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET raytube_mpi)
  install(TARGETS raytube_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/raytube)
endif()
install(TARGETS raytube_solver EXPORT raytubeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
set(public_headers
    core/complex_vector.h core/error.h core/field.h core/progress.h core/work_team.h
    scene/antenna.h scene/image.h scene/layers.h scene/look_plan.h scene/material.h scene/tube_paths.h scene/wedge_line.h
    scene/results.h scene/sweep.h
    mesh/load.h mesh/model/disjoint_sets.h mesh/model/edge_table.h mesh/model/face_tree.h mesh/model/faces.h mesh/model/geometry.h mesh/model/made_once.h mesh/model/part_names.h
    mesh/model/polygon_soup.h mesh/model/triangle_mesh.h mesh/model/triangle_rows.h mesh/read/read_mesh.h mesh/repair/build_mesh.h
    mesh/features/convexity.h mesh/features/outlines.h mesh/features/patch_borders.h mesh/features/thin_plates.h mesh/features/wedge_sets.h mesh/features/wedges.h
    mesh/smooth/creases.h mesh/smooth/smooth.h
    mesh/trace/ray.h mesh/trace/tracer.h
    sbr/replay.h sbr/sbr.h sbr/tube_paths.h sbr/beams/spectrum.h sbr/beams/tube_sums.h sbr/launch/launch.h
    utd/shadow/wedge_lines.h utd/wedge/diffracted_field.h utd/wedge/ray_source.h utd/wedge/transition.h
    scene/options.h scene/bounce_names.h scene/contribution.h plan/mechanism.h solve/image.h plan/ground_paths.h plan/plan.h solve/shard.h solve/solve.h plan/target.h)
foreach(header IN LISTS public_headers)
  cmake_path(GET header PARENT_PATH room)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/raytube/${room})
endforeach()
install(EXPORT raytubeTargets NAMESPACE raytube:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/raytube)
configure_package_config_file(raytubeConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/raytubeConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/raytube)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/raytubeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/raytubeConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/raytubeConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/raytube)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/matlab DESTINATION ${CMAKE_INSTALL_DATADIR}/raytube)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs ${PROJECT_SOURCE_DIR}/examples ${PROJECT_SOURCE_DIR}/cases DESTINATION ${CMAKE_INSTALL_DOCDIR}
        PATTERN out EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN site EXCLUDE)  # nor what builds the site
install(FILES ${PROJECT_SOURCE_DIR}/tests/data/mom/dihedral3.csv ${PROJECT_SOURCE_DIR}/tests/data/mom/dihedral3.stl
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests/data/mom)  # what an example reads
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
              ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
