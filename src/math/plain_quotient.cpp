// For compilers that cannot be told -fcx-limited-range (clang before 18). They call this function for every quotient of complex
// numbers, and that of their library, which scales its arguments first, rounds otherwise than the plain formula of all other
// compilers.

/// (a + jb) / (c + jd).
extern "C" __attribute__((visibility("hidden"))) _Complex double __divdc3(double a, double b, double c, double d) {
  const double square = c * c + d * d;
  _Complex double quotient;
  __real__ quotient = (a * c + b * d) / square;
  __imag__ quotient = (b * c - a * d) / square;
  return quotient;
}
