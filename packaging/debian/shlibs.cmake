# Run by cpack before dpkg-shlibdeps: what only the plugin of MPI is linked with is no dependency of the package.
file(WRITE ${CPACK_TEMPORARY_DIRECTORY}/debian/shlibs.local "libmpi 40\nlibmpich 12\n")
