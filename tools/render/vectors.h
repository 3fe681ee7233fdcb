// Vectors and colours of the path tracer, with the operations that the library's own vectors do not
// need. World space has z up, as the library's shading frame has.
#pragma once

#include <cmath>

#include "vndf/vec.h"

namespace vndf::render {

using Vector = Vec3<float>;

inline Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator-(const Vector& a) {
  return {-a.x, -a.y, -a.z};
}
inline Vector operator*(float s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}

inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(const Vector& a) {
  return std::sqrt(dot(a, a));
}

/// Linear red, green and blue with the primaries of sRGB: a radiance, or the factor by which a
/// surface changes one.
struct Rgb {
  float r = 0, g = 0, b = 0;

  friend Rgb operator+(const Rgb& x, const Rgb& y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
  friend Rgb operator*(const Rgb& x, const Rgb& y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
  friend Rgb operator*(float s, const Rgb& x) { return {s * x.r, s * x.g, s * x.b}; }
  Rgb& operator+=(const Rgb& x) { return *this = *this + x; }
};

/// Relative luminance (ITU-R BT.709).
inline float luminance(const Rgb& c) {
  return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

}  // namespace vndf::render
