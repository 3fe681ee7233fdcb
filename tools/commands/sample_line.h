// The lines of `vndf sample --stdin`. Each is one configuration and its random numbers, seven
// numbers with blanks between them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <istream>
#include <string>

namespace vndf::tools {

/// What one sample is drawn with: wx wy wz ax ay u1 u2.
using SampleInputs = std::array<double, 7>;

/// Bytes of a line: seven numbers with every digit take less than 200.
inline constexpr std::size_t kMostLineBytes = 1000;

/// Reads the next line of `stream`. Returns false at its end. Throws std::runtime_error for a line
/// of more than kMostLineBytes, before it fills the memory.
bool next_sample_line(std::istream& stream, std::string& line);

/// The numbers of a line. Throws std::runtime_error unless they are seven.
SampleInputs numbers_of(const std::string& line);

/// The first rule that `inputs` break in the precision T, or an empty string.
template <class T>
std::string broken_rule(const SampleInputs& inputs) {
  constexpr double kUnitSlack = 1e-3;
  const auto& [wx, wy, wz, ax, ay, u1, u2] = inputs;
  for (const double value : inputs)
    if (!std::isfinite(value)) return "every number must be finite";
  if (std::abs(std::hypot(wx, wy, wz) - 1) > kUnitSlack) return "wi must have length 1";
  if (wz < 0) return "wi must not be below the horizon (z >= 0)";
  if (!(ax > 0 && ay > 0)) return "alpha must be > 0";
  const auto is_in_range = [](double alpha) { return T(alpha) > 0 && std::isfinite(T(alpha)); };
  if (!is_in_range(ax) || !is_in_range(ay))
    return "alpha is beyond single precision; give --double";
  if (!(u1 >= 0 && u1 <= 1 && u2 >= 0 && u2 <= 1)) return "u1 and u2 must be in [0, 1]";
  return {};
}

}  // namespace vndf::tools
