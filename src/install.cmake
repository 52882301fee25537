# Installed: the program, the library, its public headers and a CMake package (find_package(raytube)).
include(CMakePackageConfigHelpers)
install(TARGETS raytube RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS raytube_solver EXPORT raytubeTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES antenna.h complex_vector.h error.h field.h image.h layers.h look_plan.h material.h progress.h random_result.h sweep.h solve.h
        solve_image.h yardstick.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/raytube)
install(FILES mesh/triangle_mesh.h mesh/load.h mesh/outlines.h mesh/thin_sheets.h mesh/smooth.h mesh/wedges.h mesh/tracer.h
        mesh/convexity.h mesh/face_tree.h mesh/faces.h mesh/geometry.h mesh/part_names.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/raytube/mesh)
install(FILES sbr/sbr.h sbr/launch.h sbr/spectrum.h sbr/tube_sums.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/raytube/sbr)
install(FILES utd/diffracted_field.h utd/ray_source.h utd/transition.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/raytube/utd)
install(EXPORT raytubeTargets NAMESPACE raytube:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/raytube)
configure_package_config_file(raytubeConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/raytubeConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/raytube)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/raytubeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/raytubeConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/raytubeConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/raytube)
