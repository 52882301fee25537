# Read by CPack. MPI is what the plugin for it alone needs, which nobody loads who has started no MPI program.
set(SHLIBDEPS_EXECUTABLE dpkg-shlibdeps -xlibopenmpi3 -xlibmpich12)
