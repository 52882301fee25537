/* The program needs the x86-64-v3 instruction set. This file does not, and runs before everything that does, so that an
 * older processor gets a sentence instead of an illegal instruction. */
#include <unistd.h>

static int has_x86_64_v3(void) {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
}

__attribute__((constructor(101))) static void refuse_old_processors(void) {
  static const char sentence[] =
      "raytube: this processor lacks the x86-64-v3 instructions (AVX2, FMA, BMI2); run it on one made since about 2015\n";
  if (has_x86_64_v3()) return;
  if (write(STDERR_FILENO, sentence, sizeof sentence - 1) < 0) _exit(2);
  _exit(2);
}
