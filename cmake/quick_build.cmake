# What makes builds of this project quicker where it is found: ccache, mold. Neither changes what is built.
find_program(RAYTUBE_CCACHE ccache)
if(RAYTUBE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache keeps what was compiled with precompiled headers only if told that these may be newer than it.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${RAYTUBE_CCACHE})
  add_compile_options($<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>>:-fpch-preprocess>)
endif()

find_program(RAYTUBE_MOLD mold)
if(RAYTUBE_MOLD AND NOT CMAKE_EXE_LINKER_FLAGS MATCHES "-fuse-ld" AND
   (NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU" OR CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12.1))
  add_link_options(-fuse-ld=mold)
endif()
