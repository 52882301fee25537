# What Debian hardens its programs with, as far as GCC does not by itself (position-independent code): bounds of memcpy and its like, and
# tables of the linker that cannot be written. No result depends on it. Canaries on the stack would cost up to 1.6 % of the instructions
# (bench/cost, edges).
target_compile_options(raytube_flags INTERFACE $<$<CONFIG:Release>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>)
target_link_options(raytube_flags INTERFACE LINKER:-z,relro,-z,now LINKER:--build-id)  # journals tell programs apart by it
