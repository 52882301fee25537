// For LD_PRELOAD: a clock that stands still, far ahead of the true one. What a program does now and then, such as keeping
// finished looks, it then never does, and its count of instructions does not depend on how fast it runs; who waits until a time
// waits to be woken.
#include <time.h>

int clock_gettime(clockid_t which, struct timespec* now) {
  (void)which;
  now->tv_sec = 4000000000;
  now->tv_nsec = 0;
  return 0;
}
