// A vector of three complex numbers: a field.
#pragma once

#include "core/field.h"

namespace raytube {

struct ComplexVector {
  dvec3 re{0.0}, im{0.0};

  ComplexVector& operator+=(const ComplexVector& other) {
    re += other.re;
    im += other.im;
    return *this;
  }
  friend ComplexVector operator+(ComplexVector a, const ComplexVector& b) { return a += b; }
  friend ComplexVector operator-(const ComplexVector& a, const ComplexVector& b) { return {a.re - b.re, a.im - b.im}; }
};

inline ComplexVector operator*(Complex factor, const dvec3& v) { return {factor.real() * v, factor.imag() * v}; }
inline ComplexVector operator*(Complex factor, const ComplexVector& v) {
  return {factor.real() * v.re - factor.imag() * v.im, factor.real() * v.im + factor.imag() * v.re};
}
inline ComplexVector cross(const dvec3& a, const ComplexVector& b) { return {glm::cross(a, b.re), glm::cross(a, b.im)}; }
inline Complex dot(const ComplexVector& v, const dvec3& direction) {
  return {glm::dot(v.re, direction), glm::dot(v.im, direction)};
}
inline double norm(const ComplexVector& v) { return std::sqrt(glm::dot(v.re, v.re) + glm::dot(v.im, v.im)); }

}  // namespace raytube
