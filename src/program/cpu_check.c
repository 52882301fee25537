/* The program needs the x86-64-v3 instruction set. This file does not, and runs before everything that does, so that an
 * older processor gets a sentence instead of an illegal instruction. */
#include <stdio.h>
#include <unistd.h>

#include "core/processor.h"

__attribute__((constructor(101))) static void refuse_old_processors(void) {
  if (has_x86_64_v3()) return;
  dprintf(STDERR_FILENO, "raytube: %s\n", processor_sentence);
  _exit(2);
}
