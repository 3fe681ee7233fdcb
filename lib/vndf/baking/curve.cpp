// Curves of the kernel.
#include "vndf/baking/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vndf::baking {
namespace {

// Single precision holds nothing below; what is smaller is written as twice this logarithm.
constexpr double kNothing = -150;
// Where a cell is compared with the function, as parts of its width.
constexpr std::array<double, 5> kPlaces{0.12, 0.3, 0.5, 0.7, 0.88};

/// Distances of the first place from 0, and bits of the mantissa in a key: enough for a smooth
/// function, for one that bends at the beginning, and for a pole there. The first that will do is
/// taken.
struct Resolution {
  double offset;
  int bits;
};
constexpr std::array<Resolution, 4> kResolutions{
    {{0x1p-4, 2}, {0x1p-6, 3}, {0x1p-12, 4}, {0x1p-24, 5}}};

/// One segment of a curve over places x - begin + offset.
class Segment {
 public:
  Segment(const CurveSpan& span, const std::function<double(double)>& log2, double tolerance)
      : span_(span), log2_(log2), tolerance_(tolerance / std::log(2.0) / 2) {
    for (const Resolution& resolution : kResolutions) {
      offset_ = resolution.offset;
      axis_ = cells_between(offset_, span.end - span.begin + offset_, resolution.bits,
                            [&](double begin, double end) { return follows(begin, end); });
      if (!axis_.too_coarse) break;
    }
  }

  /// Whether a cell of one key follows the function too little.
  bool too_coarse() const { return axis_.too_coarse; }

  KernelSegment put(KernelBlock& block) const {
    block.align(16);
    const std::uint32_t first = block.at();
    for (const AxisCell& cell : axis_.cells) block.put_cubic(cubic(cell.begin, cell.end));
    const KernelAxis axis = block.put_guide(axis_, first, 16);
    return {static_cast<float>(span_.begin),
            axis.guide - (axis.first_key << 3),
            static_cast<float>(span_.end),
            axis.shift,
            static_cast<float>(offset_),
            axis.first_key,
            axis.count,
            0};
  }

 private:
  double slope_at(double place) const {
    return std::clamp(span_.begin + (place - offset_), span_.begin, span_.end);
  }

  Node node(double place) const {
    constexpr double kStep = 1e-5, kLeastStep = 1e-12;
    const double x = slope_at(place);
    const double low = std::max(x * (1 - kStep) - kLeastStep, span_.begin),
                 high = std::min(x * (1 + kStep) + kLeastStep, span_.end);
    const double value = log2_(x), below = x > low ? log2_(low) : value,
                 above = x < high ? log2_(high) : value;
    return {value, (above - below) / (high - low)};
  }

  /// The cubic of a cell; a constant where there is nothing, or no width.
  Cubic cubic(double begin, double end) const {
    const Node left = node(begin), right = node(end);
    if (!(end > begin) || (left.value < kNothing && right.value < kNothing))
      return {std::max(left.value, 2 * kNothing), 0, 0, 0};
    return hermite(left, right, end - begin);
  }

  bool follows(double begin, double end) const {
    // Of a longer cell all places would be far from its beginning.
    constexpr double kLongest = 4;
    if (end > kLongest * begin && log2_(slope_at(begin)) >= kNothing) return false;
    const Cubic c = cubic(begin, end);
    return std::ranges::all_of(kPlaces, [&](double f) {
      const double exact = log2_(slope_at(begin + f * (end - begin)));
      const double value = baking::at(c, f * (end - begin));
      return std::abs(value - exact) <= tolerance_ || (exact < kNothing && value < kNothing);
    });
  }

  CurveSpan span_;
  std::function<double(double)> log2_;
  double tolerance_;  // of the logarithm; half is left to what lies between the places
  double offset_ = 0;
  Axis axis_;
};

/// Segments of one span, halved to its end where keys are too coarse: those of a segment crowd at
/// its beginning alone, and a density that falls to 0 at a rim bends most at its end.
std::vector<Segment> segments_of(CurveSpan span, const std::function<double(double)>& log2,
                                 double tolerance) {
  constexpr double kNarrowest = 0x1p-20;
  const double narrowest = kNarrowest * (span.end - span.begin);
  std::vector<Segment> segments;
  for (;;) {
    const Segment rest(span, log2, tolerance);
    const double middle = static_cast<float>((span.begin + span.end) / 2);
    if (!rest.too_coarse() || span.end - span.begin < narrowest) {
      segments.push_back(rest);
      return segments;
    }
    segments.emplace_back(CurveSpan{span.begin, middle}, log2, tolerance);
    span.begin = middle;
  }
}

/// The end `x` of a span, moved towards `inside` where its rounding has left the curve.
double held_inside(float x, float inside, const std::function<double(double)>& log2) {
  constexpr int kSteps = 4;
  for (int k = 0; k < kSteps && !std::isfinite(log2(double{x})); ++k) x = std::nextafter(x, inside);
  return x;
}

}  // namespace

std::vector<CurveSpan> spans_of(const LogCurve<double>& curve, double unit,
                                const std::function<double(double)>& log2) {
  std::vector<CurveSpan> spans;
  for (const auto& segment : curve.segments()) {
    const auto begin = static_cast<float>(std::sinh(segment.begin) / unit),
               end = static_cast<float>(std::sinh(segment.end) / unit);
    spans.push_back({held_inside(begin, end, log2), held_inside(end, begin, log2)});
  }
  // Beyond the end of the last span the kernel has nothing.
  double& end = spans.back().end;
  while (curve.open() && end < kernel::kVndfFarthest && log2(end) > kNothing)
    end = std::min(2 * end, double{kernel::kVndfFarthest});
  return spans;
}

kernel::VndfCurve put_curve(KernelBlock& block, const std::vector<CurveSpan>& spans,
                            const std::function<double(double)>& log2, double tolerance) {
  std::vector<KernelSegment> segments;
  for (const CurveSpan& span : spans)
    for (const Segment& segment : segments_of(span, log2, tolerance))
      segments.push_back(segment.put(block));
  block.align(16);
  const kernel::VndfCurve written{block.at(), static_cast<std::uint32_t>(segments.size())};
  for (const KernelSegment& segment : segments) block.put(segment);
  return written;
}

}  // namespace vndf::baking
