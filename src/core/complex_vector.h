// A vector of three complex numbers: a field.
#pragma once

#include "core/field.h"

namespace raytube {

/// A vector of complex components.
struct ComplexVector {
  dvec3 re{0.0}, im{0.0};  // real and imaginary part

  /// Entry by entry.
  ComplexVector& operator+=(const ComplexVector& other) {
    re += other.re;
    im += other.im;
    return *this;
  }
  /// Entry by entry.
  friend ComplexVector operator+(ComplexVector a, const ComplexVector& b) { return a += b; }
  /// Entry by entry.
  friend ComplexVector operator-(const ComplexVector& a, const ComplexVector& b) { return {a.re - b.re, a.im - b.im}; }
};

/// A real vector times a complex number.
inline ComplexVector operator*(Complex factor, const dvec3& v) { return {factor.real() * v, factor.imag() * v}; }
/// A vector times a complex number.
inline ComplexVector operator*(Complex factor, const ComplexVector& v) {
  return {factor.real() * v.re - factor.imag() * v.im, factor.real() * v.im + factor.imag() * v.re};
}
/// a x b.
inline ComplexVector cross(const dvec3& a, const ComplexVector& b) { return {glm::cross(a, b.re), glm::cross(a, b.im)}; }
/// Along a real direction; nothing is conjugated.
inline Complex dot(const ComplexVector& v, const dvec3& direction) {
  return {glm::dot(v.re, direction), glm::dot(v.im, direction)};
}
/// Root of the sum of the squared magnitudes of the components.
inline double norm(const ComplexVector& v) { return std::sqrt(glm::dot(v.re, v.re) + glm::dot(v.im, v.im)); }

}  // namespace raytube
