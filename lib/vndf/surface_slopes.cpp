// Turned surfaces, and the rules and the text of the numbers of a surface.
#include "vndf/surface_slopes.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace vndf {
namespace {

/// Numbers of a surface in the order of its text.
using Numbers = std::array<double, 5>;

Numbers numbers_of(const SurfaceSlopes& s) {
  return {s.alpha.x, s.alpha.y, s.correlation, s.mean.x, s.mean.y};
}

}  // namespace

SurfaceSlopes turned(const Alpha<double>& alpha, double degrees) {
  const double least = std::remainder(degrees, 180.0);  // from -90 to 90
  const bool quarter = std::abs(least) == 90;
  const double c = quarter ? 0 : std::cos(least * std::numbers::pi / 180);
  const double s = quarter ? 1 : std::sin(least * std::numbers::pi / 180);
  const Alpha<double> across{std::hypot(alpha.x * c, alpha.y * s),
                             std::hypot(alpha.x * s, alpha.y * c)};
  const double ratios =
      alpha.x / across.x * (alpha.x / across.y) - alpha.y / across.x * (alpha.y / across.y);
  return {across, ratios * c * s};
}

std::optional<std::string> check(const SurfaceSlopes& slopes) {
  const auto& [alpha, correlation, mean] = slopes;
  const auto is_roughness = [](double a) { return a > 0 && std::isfinite(a); };
  if (!is_roughness(alpha.x) || !is_roughness(alpha.y)) return "alpha must be finite and > 0";
  if (!(std::abs(correlation) < 1)) return "the correlation must be inside (-1, 1)";
  if (!std::isfinite(mean.x) || !std::isfinite(mean.y)) return "the mean slope must be finite";
  return {};
}

std::string text_of(const SurfaceSlopes& slopes) {
  std::string text;
  for (const double number : numbers_of(slopes)) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    text.append(text.empty() ? "" : " ").append(digits.begin(), end);
  }
  return text;
}

std::optional<SurfaceSlopes> surface_slopes_of(std::string_view text) {
  Numbers numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0 && (at == end || *at++ != ' ')) return {};
    const auto [next, error] = std::from_chars(at, end, numbers[k]);
    if (error != std::errc()) return {};
    at = next;
  }
  const auto& [alpha_x, alpha_y, correlation, mean_x, mean_y] = numbers;
  const SurfaceSlopes slopes{{alpha_x, alpha_y}, correlation, {mean_x, mean_y}};
  if (at != end || check(slopes)) return {};
  return slopes;
}

}  // namespace vndf
