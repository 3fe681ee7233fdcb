// A positive function of one non-negative slope, such as D. A power tail is a straight line in the
// logarithm over a = asinh(slope), so that is what is kept, as cubic Hermite splines in segments,
// between which the function may jump or have a kink. The nodes of a segment are equidistant in t,
// which can be graded to crowd them at its ends. Outside the segments the function is 0; only an
// open curve goes on straight beyond its last one, which continues a power tail exactly, while a
// light tail has fallen to nothing there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "vndf/cubic_piece.h"
#include "vndf/select.h"

namespace vndf {

/// How t follows z = (a - begin) / (end - begin), both in [0, 1].
enum class Grading : int {
  none = 0,  ///< t = z
  low = 1,   ///< t = sqrt(z): for a cusp at the beginning
  both = 2,  ///< t = sqrt(z) / (sqrt(z) + sqrt(1 - z)): for singular ends
};

template <class T>
T graded(T z, Grading grading) {
  if (grading == Grading::none) return z;
  const T low = std::sqrt(z);
  return grading == Grading::low ? low : low / (low + std::sqrt(T(1) - z));
}

/// Inverse of graded().
template <class T>
T graded_inverse(T t, Grading grading) {
  if (grading == Grading::none) return t;
  const T low = t * t;
  return grading == Grading::low ? low : low / (low + (T(1) - t) * (T(1) - t));
}

/// dz / dt.
template <class T>
T graded_inverse_derivative(T t, Grading grading) {
  if (grading == Grading::none) return T(1);
  if (grading == Grading::low) return T(2) * t;
  const T norm = t * t + (T(1) - t) * (T(1) - t);
  return T(2) * t * (T(1) - t) / (norm * norm);
}

template <class T>
struct LogCurveSegment {
  T begin, end;  ///< asinh(slope)
  Grading grading;
  std::vector<CubicNode<T>> nodes;  ///< of the logarithm of the function; at least two
};

template <class T>
class LogCurve {
 public:
  LogCurve() = default;
  /// Segments in increasing order, not overlapping; `open` if the last one is continued.
  LogCurve(std::vector<LogCurveSegment<T>> segments, bool open)
      : segments_(std::move(segments)), open_(open) {}

  template <class U>
  explicit LogCurve(const LogCurve<U>& other) : open_(other.open()) {
    for (const auto& s : other.segments()) {
      segments_.push_back({static_cast<T>(s.begin), static_cast<T>(s.end), s.grading, {}});
      for (const auto& n : s.nodes)
        segments_.back().nodes.push_back({static_cast<T>(n.value), static_cast<T>(n.tangent)});
    }
  }

  const std::vector<LogCurveSegment<T>>& segments() const { return segments_; }
  bool open() const { return open_; }

  /// Logarithm of the function at the slope whose asinh is `a` >= 0, infinite included; minus
  /// infinity where the function is 0.
  T log_at(T a) const {
    const T inside = a > T(0) ? a : T(0);
    for (const auto& s : segments_) {
      if (inside > s.end) continue;
      if (inside < s.begin) break;
      const Place p = place_in(s, inside);
      return piece_at(s, p).at(p.fraction);
    }
    return open_ && inside > segments_.back().end ? continuation(inside)
                                                  : -std::numeric_limits<T>::infinity();
  }

  /// The function itself at the slope whose asinh is `a`.
  T at(T a) const { return std::exp(log_at(a)); }

  /// Derivative of the logarithm with respect to asinh(slope), inside a segment or beyond the last.
  T log_slope_at(T a) const {
    for (const auto& s : segments_)
      if (a >= s.begin && a <= s.end) {
        const Place p = place_in(s, inside_graded(s, a));
        const T per_t = piece_at(s, p).derivative(p.fraction) * static_cast<T>(s.nodes.size() - 1);
        return per_t / (graded_inverse_derivative(p.t, s.grading) * (s.end - s.begin));
      }
    return end_slope();
  }

 private:
  struct Place {
    std::size_t index;
    T fraction, t;
  };

  static Place place_in(const LogCurveSegment<T>& s, T a) {
    const T z = std::clamp((a - s.begin) / (s.end - s.begin), T(0), T(1));
    const T t = graded(z, s.grading);
    const T scaled = t * static_cast<T>(s.nodes.size() - 1);
    // What is not a number has no index, but keeps its value as the fraction.
    const auto node = static_cast<std::size_t>(larger(scaled, T(0)));
    const std::size_t index = std::min(node, s.nodes.size() - 2);
    return {index, scaled - static_cast<T>(index), t};
  }

  /// An end of a graded segment has no derivative; the nearest place that has one stands for it.
  static T inside_graded(const LogCurveSegment<T>& s, T a) {
    constexpr T kNearest = T(0x1p-40);
    if (s.grading == Grading::none) return a;
    const T margin = kNearest * (s.end - s.begin);
    return std::clamp(a, s.begin + margin, s.end - margin);
  }

  T end_slope() const {
    const auto& s = segments_.back();
    return s.nodes.back().tangent * static_cast<T>(s.nodes.size() - 1) /
           (graded_inverse_derivative(T(1), s.grading) * (s.end - s.begin));
  }

  T continuation(T a) const {
    constexpr T kFarthest = T(1e6);  // beyond it nothing changes, and infinity times 0 is no number
    return segments_.back().nodes.back().value +
           end_slope() * (std::min(a, kFarthest) - segments_.back().end);
  }

  static CubicPiece<T> piece_at(const LogCurveSegment<T>& s, const Place& p) {
    return hermite_piece(s.nodes[p.index], s.nodes[p.index + 1]);
  }

  std::vector<LogCurveSegment<T>> segments_;
  bool open_ = false;
};

}  // namespace vndf
