// The lines of `vndf sample --stdin`. Each is one configuration and its random numbers: seven
// numbers with blanks between them, or ten where the surface has a correlation or a mean slope.
#pragma once

#include <cmath>
#include <istream>
#include <string>

#include "vndf/surface_slopes.h"
#include "vndf/vec.h"

namespace vndf::tools {

/// What one sample is drawn with.
struct SampleInputs {
  Vec3<double> wi{0, 0, 1};
  SurfaceSlopes surface{{1, 1}};
  double u1 = 0, u2 = 0;
};

/// Bytes of a line: ten numbers with every digit take less than 300.
inline constexpr std::size_t kMostLineBytes = 1000;

/// What a line must be, for messages.
inline constexpr char kLineForm[] = "wx wy wz ax ay [correlation mean_x mean_y] u1 u2";

/// Reads the next line of `stream`. Returns false at its end. Throws std::runtime_error for a line
/// of more than kMostLineBytes, before it fills the memory.
bool next_sample_line(std::istream& stream, std::string& line);

/// The inputs of a line. Throws std::runtime_error unless it is seven numbers or ten.
SampleInputs inputs_of(const std::string& line);

/// The first rule that `inputs` break in the precision T, or an empty string.
template <class T>
std::string broken_rule(const SampleInputs& inputs) {
  constexpr double kUnitSlack = 1e-3;
  const auto& [wi, slopes, u1, u2] = inputs;
  // A length of one is finite.
  if (!(std::abs(std::hypot(wi.x, wi.y, wi.z) - 1) <= kUnitSlack))
    return "wi must be finite and have length 1";
  if (const auto broken = check(slopes)) return *broken;
  const RoughSurface<T> surface = slopes.surface<T>();
  const auto is_in_range = [](T alpha) { return alpha > 0 && std::isfinite(alpha); };
  if (!is_in_range(surface.alpha().x) || !is_in_range(surface.alpha().y) ||
      !std::isfinite(surface.shear()) || !std::isfinite(surface.mean().x) ||
      !std::isfinite(surface.mean().y))
    return "alpha, correlation or mean slope is beyond single precision; give --double";
  if (!(u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1)) return "u1 and u2 must be in [0, 1]";
  return {};
}

}  // namespace vndf::tools
