// A positive function of one non-negative slope, kept as the logarithm of its values over
// a = asinh(slope): cubic Hermite between equidistant nodes, straight beyond the last one. A power
// tail is a straight line there, so it is continued exactly; a light tail has fallen to nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace vndf {

/// Logarithm of the function at a node and its derivative per node spacing.
template <class T>
struct LogCurveNode {
  T value, tangent;
};

template <class T>
class LogCurve {
 public:
  LogCurve() = default;
  /// `step` is the spacing of the nodes in asinh(slope); at least two nodes.
  LogCurve(T step, std::vector<LogCurveNode<T>> nodes)
      : step_(step), inverse_step_(T(1) / step), nodes_(std::move(nodes)) {}

  template <class U>
  explicit LogCurve(const LogCurve<U>& other)
      : step_(static_cast<T>(other.step())), inverse_step_(static_cast<T>(1 / other.step())) {
    nodes_.reserve(other.nodes().size());
    for (const auto& n : other.nodes())
      nodes_.push_back({static_cast<T>(n.value), static_cast<T>(n.tangent)});
  }

  T step() const { return step_; }
  const std::vector<LogCurveNode<T>>& nodes() const { return nodes_; }

  /// Logarithm of the function at the slope whose asinh is `a` >= 0, infinite included.
  T log_at(T a) const {
    constexpr T kFarthest = T(1e6);  // nodes; beyond it nothing changes and an index would overflow
    const T scaled = a > T(0) ? std::min(a * inverse_step_, kFarthest) : T(0);
    const std::size_t cells = nodes_.size() - 1;
    const std::size_t i = static_cast<std::size_t>(scaled);
    if (i >= cells) return nodes_[cells].value + nodes_[cells].tangent * (scaled - T(cells));
    return hermite(nodes_[i], nodes_[i + 1], scaled - T(i));
  }

  /// The function itself at the slope whose asinh is `a`.
  T at(T a) const { return std::exp(log_at(a)); }

  /// Derivative of the logarithm with respect to asinh(slope).
  T log_slope_at(T a) const {
    const T scaled = a > T(0) ? a * inverse_step_ : T(0);
    const std::size_t cells = nodes_.size() - 1;
    if (!(scaled < T(cells))) return nodes_[cells].tangent * inverse_step_;
    const std::size_t i = static_cast<std::size_t>(scaled);
    return hermite_derivative(nodes_[i], nodes_[i + 1], scaled - T(i)) * inverse_step_;
  }

 private:
  static T hermite(const LogCurveNode<T>& l, const LogCurveNode<T>& r, T f) {
    const T secant = r.value - l.value;
    const T c2 = T(3) * secant - T(2) * l.tangent - r.tangent;
    const T c3 = l.tangent + r.tangent - T(2) * secant;
    return l.value + f * (l.tangent + f * (c2 + f * c3));
  }
  static T hermite_derivative(const LogCurveNode<T>& l, const LogCurveNode<T>& r, T f) {
    const T secant = r.value - l.value;
    const T c2 = T(3) * secant - T(2) * l.tangent - r.tangent;
    const T c3 = l.tangent + r.tangent - T(2) * secant;
    return l.tangent + f * (T(2) * c2 + f * T(3) * c3);
  }

  T step_ = 1, inverse_step_ = 1;
  std::vector<LogCurveNode<T>> nodes_;
};

}  // namespace vndf
