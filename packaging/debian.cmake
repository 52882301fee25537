# The Debian package: cmake --build build --target deb, or cpack in build/ once everything is built.
find_program(RAYTUBE_GZIP gzip REQUIRED)
find_program(RAYTUBE_PARSECHANGELOG dpkg-parsechangelog REQUIRED)
function(raytube_from_changelog field result)
  execute_process(COMMAND ${RAYTUBE_PARSECHANGELOG} -l debian/changelog -S ${field} WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
                  OUTPUT_VARIABLE value OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(${result} ${value} PARENT_SCOPE)
endfunction()
raytube_from_changelog(Version version_and_release)
if(NOT version_and_release MATCHES "^${PROJECT_VERSION}-([0-9]+)$")
  message(FATAL_ERROR "packaging/debian/changelog begins with ${version_and_release}: add an entry for version ${PROJECT_VERSION}")
endif()
set(CPACK_DEBIAN_PACKAGE_RELEASE ${CMAKE_MATCH_1})
raytube_from_changelog(Maintainer CPACK_PACKAGE_CONTACT)
raytube_from_changelog(Timestamp changed)

# What Debian asks of packages and of nobody else: the component "debian", which `cmake --install` leaves out.
set(documents ${CMAKE_INSTALL_DATADIR}/doc/raytube)
function(raytube_install_gzipped source name)
  set(packed ${CMAKE_CURRENT_BINARY_DIR}/${name}.gz)
  add_custom_command(OUTPUT ${packed} COMMAND ${RAYTUBE_GZIP} -9nc ${source} > ${packed} DEPENDS ${source} VERBATIM)
  target_sources(raytube_pages PRIVATE ${packed})
  install(FILES ${packed} DESTINATION ${documents} COMPONENT debian EXCLUDE_FROM_ALL)
endfunction()
raytube_install_gzipped(${CMAKE_CURRENT_SOURCE_DIR}/debian/changelog changelog.Debian)
raytube_install_gzipped(${PROJECT_SOURCE_DIR}/CHANGELOG.md changelog)
install(FILES debian/copyright DESTINATION ${documents} COMPONENT debian EXCLUDE_FROM_ALL)
install(FILES debian/lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME raytube COMPONENT debian
        EXCLUDE_FROM_ALL)
install(DIRECTORY ${pages}/zsh/ DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT debian EXCLUDE_FROM_ALL)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};raytube;Unspecified;/;${PROJECT_BINARY_DIR};raytube;debian;/")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "radar cross-section of triangle meshes, deterministic")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "raytube computes the complex, polarimetric radar cross-section of a triangle
mesh, monostatic or bistatic, at any number of frequencies: physical optics
of tubes of rays that are as wide as surfaces allow, fringe currents at sharp
edges, waves that edges diffract onto other faces, coats, sheets and
absorbers. Every number comes with its numerical error and with what
asymptotic theory leaves out; equal input gives equal bytes.
.
The package holds the program, the package raytube for Python, a static C++
library with headers and CMake package, readers for MATLAB and Octave,
completions for bash and zsh, and the documentation with its cases.")

# Libraries that the program runs with are found by dpkg-shlibdeps. Pictures are worth having and not needed. Who links the static library
# needs the -dev packages below and a compiler; to recommend them would bring 270 packages of 1.1 GB to everybody who wants the program.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/debian/shlibs.cmake)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, libcgal-dev, libembree-dev, libfmt-dev, libglm-dev, libtbb-dev, \
zlib1g-dev, libexpat1-dev, libzip-dev")
if(TARGET raytube_mpi)
  string(APPEND CPACK_DEBIAN_PACKAGE_SUGGESTS ", openmpi-bin")
endif()
if(TARGET raytube_python)
  # The module is of one version of Python, as its file name says.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS
      "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_minor}), python3-numpy, python3-xarray")
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", python3-matplotlib, python3-scipy, python3-pandas, libjs-three")
  string(APPEND CPACK_DEBIAN_PACKAGE_SUGGESTS ", python3-mpi4py, python3-openimageio, python3-netcdf4")
  set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_SOURCE_DIR}/debian/postinst;${CMAKE_CURRENT_SOURCE_DIR}/debian/prerm")
endif()
include(CPack)

# Files carry the date of the changelog's entry, so that equal files make an equal package.
add_custom_target(deb COMMAND ${CMAKE_COMMAND} -E env SOURCE_DATE_EPOCH=${changed} ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
                  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} VERBATIM)
add_dependencies(deb raytube raytube_solver raytube_pages)
if(TARGET raytube_python)
  add_dependencies(deb raytube_python)
endif()
