// Many normals for one incident direction and roughness (Heitz and d'Eon 2014, Algorithm 4): all
// that depends on them alone is done once, the stretch (step 1) and the row of the marginal table,
// so that a sample is a lookup along one blended row, one in the conditional table and the normal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "vndf/stretch.h"
#include "vndf/table.h"
#include "vndf/table_coordinates.h"
#include "vndf/tabulated_sampler.h"
#include "vndf/vec.h"

namespace vndf {

/// Rows of a table around a row coordinate and their weights, of which only the first `count` have
/// a meaning: 1, 2 or 4.
template <class T>
struct WeightedRows {
  std::size_t first = 0, count = 1;
  Four<T> weights{T(1), T(0), T(0), T(0)};
};

template <class T>
WeightedRows<T> weighted_rows(const QuantileTable& table, T row_coordinate) {
  if (table.rows() == 1) return {};
  const int rows = static_cast<int>(table.rows());
  if (table.blend() == RowBlend::cubic) {
    const RowWeights<T> r = lagrange_rows(row_coordinate, rows);
    return {static_cast<std::size_t>(r.first), 4, r.weights};
  }
  const Cell<T> r = cell_of(row_coordinate, rows);
  return {static_cast<std::size_t>(r.index), 2, {T(1) - r.fraction, r.fraction, T(0), T(0)}};
}

inline constexpr double kIncidentRoundings = 8;

/// What sampling needs to know of one incident direction and roughness.
template <class T>
struct Incident {
  /// False for an input outside its range, whose samples are all (0, 0, 1).
  bool valid = false;
  /// Roughness in units in which the mean slope is 1.
  Alpha<T> alpha{T(1), T(1)};
  Azimuth<T> phi{T(1), T(0), T(0)};
  /// The largest slope seen, and the same at the order of the marginal table.
  BoundedSlope<T> edge{T(1), T(0)}, ordered_edge{T(1), T(0)};
  WeightedRows<T> rows;
};

/// Draws what TabulatedSampler::sample(wi, alpha, u1, u2) draws, but for a change of u1 by
/// kIncidentRoundings roundings of 1 and of as many in the angle at unit roughness: the blend of
/// rows is summed in another order. Refers to the sampler, which must live as long. Nothing
/// allocates or throws.
template <class T>
class IncidentSampler {
 public:
  IncidentSampler(const TabulatedSampler<T>& sampler, const Vec3<T>& wi,
                  const Alpha<T>& alpha) noexcept
      : sampler_(&sampler) {
    if (!valid(wi, alpha)) return;
    incident_.valid = true;
    // 1. stretch
    const auto s = sampler.stretch(wi, alpha);
    incident_.alpha = s.alpha;
    incident_.phi = s.phi;
    incident_.edge = sampler.farthest(s.c);
    incident_.ordered_edge = to_order(incident_.edge, sampler.tables().tail_order);
    incident_.rows = weighted_rows(sampler.tables().marginal, sampler.marginal_row(s.c));
  }

  const TabulatedSampler<T>& sampler() const { return *sampler_; }
  const Incident<T>& incident() const { return incident_; }

  /// Draws a normal as TabulatedSampler::sample() does.
  Vec3<T> sample(T u1, T u2) const noexcept {
    if (!incident_.valid) return {T(0), T(0), T(1)};
    // 2.a marginal, 2.b conditional
    const auto slope = sampler_->sample_across(sample_marginal(probability(u1)), u2);
    // 3. rotate, 4. unstretch, 5. compute the normal
    return unstretched_normal(slope, incident_.phi, incident_.alpha);
  }

 private:
  /// The marginal quantile at u1, in units of the mean slope; at most the edge.
  BoundedSlope<T> sample_marginal(const Probability<T>& u1) const {
    const T w = lookup(marginal_column(u1));
    const MonotoneMap<T>& map = sampler_->marginal_map();
    const T sigma = map.identity() ? incident_.edge.sigma * w : map.at(w);
    const BoundedSlope<T> ordered =
        bounded_from_sigma(smaller(sigma, incident_.ordered_edge.sigma));
    return held_below(incident_.edge, from_order(ordered, sampler_->tables().tail_order));
  }

  /// The marginal table at a column coordinate.
  T lookup(T column) const {
    const QuantileTable& table = sampler_->tables().marginal;
    const Cell<T> c = cell_of(column, static_cast<int>(table.columns()));
    if constexpr (std::is_same_v<T, double>)
      if (table.in_double()) return along(table.template row<double>(incident_.rows.first), c);
    return along(table.row(incident_.rows.first), c);
  }

  /// The monotone cubic in the cell `c` of the blend of the rows from `row` on.
  template <class V>
  T along(const CubicNode<V>* row, const Cell<T>& c) const {
    const std::size_t stride = sampler_->tables().marginal.columns();
    const WeightedRows<T>& rows = incident_.rows;
    Four<T> nodes{};
    for (std::size_t r = 0; r < rows.count; ++r) {
      const Four<T> two = two_nodes<T>(row + r * stride + c.index);
      for (std::size_t k = 0; k < 4; ++k) nodes[k] += rows.weights[r] * two[k];
    }
    const CubicPiece<T> piece =
        hermite_piece(rows.count == 4 ? with_limited_tangents(nodes) : nodes);
    return smaller(larger(piece.at(c.fraction), T(0)), T(1));
  }

  const TabulatedSampler<T>* sampler_;
  Incident<T> incident_;
};

}  // namespace vndf
