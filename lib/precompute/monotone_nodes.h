// Tangents for the nodes of a MonotoneMap.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "vndf/monotone_map.h"

namespace vndf::precompute {

/// Limits the tangents to what keeps the map increasing.
inline void limit_tangents(std::vector<MonotoneNode>& nodes) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const auto rise = [&](std::size_t i) { return nodes[i + 1].value - nodes[i].value; };
    double most = kSteepest * (k > 0 ? rise(k - 1) : rise(k));
    if (k + 1 < nodes.size()) most = std::min(most, kSteepest * rise(k));
    nodes[k].tangent = std::clamp(nodes[k].tangent, 0.0, most);
  }
}

/// Tangents of the first and the last node, where those of the map itself may be 0 or infinite: of
/// the parabola through the node with the value and tangent of its neighbour.
inline void set_end_tangents(std::vector<MonotoneNode>& nodes) {
  const auto parabola = [](const MonotoneNode& end, const MonotoneNode& beside) {
    return 2 * std::abs(beside.value - end.value) - beside.tangent;
  };
  const std::size_t last = nodes.size() - 1;
  nodes[0].tangent = parabola(nodes[0], nodes[1]);
  nodes[last].tangent = parabola(nodes[last], nodes[last - 1]);
}

/// Tangents by differences of order 4, 2 next to the ends. At least three nodes.
inline void set_tangents(std::vector<MonotoneNode>& nodes) {
  const std::size_t last = nodes.size() - 1;
  const auto v = [&](std::size_t k) { return nodes[k].value; };
  for (std::size_t k = 1; k < last; ++k) {
    const double near = (v(k + 1) - v(k - 1)) / 2;
    const bool inside = k >= 2 && k + 2 <= last;
    nodes[k].tangent = inside ? (8 * near * 2 - (v(k + 2) - v(k - 2))) / 12 : near;
  }
  set_end_tangents(nodes);
  limit_tangents(nodes);
}

}  // namespace vndf::precompute
