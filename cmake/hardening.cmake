# What Debian hardens its programs with, as far as GCC does not by itself (position-independent code): canaries on the stack, bounds of
# memcpy and its like, tables of the linker that cannot be written. No result depends on it.
target_compile_options(raytube_flags INTERFACE $<$<CONFIG:Release>:-fstack-protector-strong;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>)
target_link_options(raytube_flags INTERFACE LINKER:-z,relro,-z,now)
