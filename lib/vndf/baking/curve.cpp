// Bakes curves: segments, and the cells in which one cubic follows the logarithm.
#include "vndf/baking/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vndf::baking {
namespace {

// 2^-150 is 0 in single precision. Whatever is smaller is written with twice this logarithm.
constexpr double kNothing = -150;
// Where in a cell its cubic is compared with the function, as parts of the width of the cell.
constexpr std::array<double, 5> kPlaces{0.12, 0.3, 0.5, 0.7, 0.88};

/// The distance of the first place from 0 and the bits of the mantissa in a key, which decide how
/// fine cells can be at the beginning of a segment. The first of the list is enough for a smooth
/// function, the next for one that bends at its beginning, and the last two for a cusp and a pole
/// there; the first that is fine enough is taken, for it has the smallest guide.
struct Resolution {
  double offset;
  int bits;
};
constexpr std::array<Resolution, 4> kResolutions{
    {{0x1p-4, 2}, {0x1p-6, 3}, {0x1p-12, 4}, {0x1p-24, 5}}};

/// One segment of a curve and its cells, over the places x - begin + offset.
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

  /// Whether some cell of one key does not follow the function.
  bool too_coarse() const { return axis_.too_coarse; }

  KernelSegment put(KernelBlock& block) const {
    block.align(16);
    const std::uint32_t first = block.at();
    for (const AxisCell& cell : axis_.cells) block.put_cubic(cubic(cell.begin, cell.end));
    const KernelAxis axis = block.put_guide({{axis_, first, 16}});
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

  /// The logarithm and its derivative, from a difference, since curves are given by values alone.
  Node node(double place) const {
    constexpr double kStep = 1e-5, kLeastStep = 1e-12;
    const double x = slope_at(place);
    const double low = std::max(x * (1 - kStep) - kLeastStep, span_.begin),
                 high = std::min(x * (1 + kStep) + kLeastStep, span_.end);
    const double value = log2_(x), below = x > low ? log2_(low) : value,
                 above = x < high ? log2_(high) : value;
    return {value, (above - below) / (high - low)};
  }

  /// The cubic of a cell; a constant where the function is 0 or the cell has no width.
  Cubic cubic(double begin, double end) const {
    const Node left = node(begin), right = node(end);
    if (!(end > begin) || (left.value < kNothing && right.value < kNothing))
      return {std::max(left.value, 2 * kNothing), 0, 0, 0};
    return hermite(left, right, end - begin);
  }

  bool follows(double begin, double end) const {
    // A longer cell would be compared at places that all lie far from its beginning.
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
  double tolerance_;  // of the logarithm; the other half is for what lies between the places
  double offset_ = 0;
  Axis axis_;
};

/// The segments of one span. Keys of a segment crowd at its beginning alone, but a density that
/// falls to 0 at a rim bends most at its end. Where keys are too coarse the span is therefore
/// halved, again and again towards its end.
std::vector<Segment> segments_of(CurveSpan span, const std::function<double(double)>& log2,
                                 double tolerance) {
  constexpr double kNarrowest = 0x1p-20;  // of the span: a few digits of single precision remain
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

/// The end `x` of a span. It is moved towards `inside` if rounding has carried it out of the curve.
double moved_inside(float x, float inside, const std::function<double(double)>& log2) {
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
    spans.push_back({moved_inside(begin, end, log2), moved_inside(end, begin, log2)});
  }
  // The kernel's curve is 0 beyond its last span, where that of the pair goes on.
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
