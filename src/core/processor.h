/* What a processor has to have, for the two that ask before any other code of this project runs: the program (program/cpu_check.c) and the
 * Python package (python/bindings/processor.c). In C, and compiled for any x86-64. */
#pragma once

static const char processor_sentence[] =
    "this processor lacks the x86-64-v3 instructions (AVX2, FMA, BMI2); run raytube on one made since about 2015";

static int has_x86_64_v3(void) {
  __builtin_cpu_init();
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("bmi2");
}
