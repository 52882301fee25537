# Installs the build into a scratch folder, builds the example against it with find_package(raytube), and runs it.
#   cmake -DBUILD=... -DSOURCE=... -DSCRATCH=... -DFLAGS=... -P run.cmake      FLAGS: compiler flags of the build
function(must)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "failed (${code}): ${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
must(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix)
must(${CMAKE_COMMAND} -S ${SOURCE}/examples/library -B ${SCRATCH}/example -G Ninja -DCMAKE_BUILD_TYPE=Release
     -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix "-DCMAKE_CXX_FLAGS=${FLAGS}")
must(${CMAKE_COMMAND} --build ${SCRATCH}/example)
must(${SCRATCH}/example/example ${SOURCE}/cases/plate/plate.off)
# Broadside of a 1.5 m plate at 3 GHz: A / lambda = 2.25 / 0.0999308 = 22.5156 m, and -0.14 % from its edges.
if(NOT output MATCHES "22\\.484")
  message(FATAL_ERROR "the example printed '${output}', not |S_vv| = 22.484... m")
endif()
must(${SCRATCH}/prefix/bin/raytube --version)
