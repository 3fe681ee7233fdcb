// The two tables of Heitz and d'Eon 2014 (sections 5.3 and 5.4) read literally, so that the
// benchmark shows what the coordinates of table_coordinates.h gain. Angles and random numbers are
// uniform, slopes are stored as they are, and the lookup is bilinear.
//
//   T_x[theta, u1]   theta = (pi / 2) i / (n - 1),          u1 = j / (n - 1),   value x
//   T_y[x, u2]       atan(x) = pi (i / (n - 1) - 1 / 2),    u2 = j / (n - 1),   value y
//
// The paper does not say how x is spread over rows. We choose its angle, in analogy to theta.
// Slopes are those of unit roughness.
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "vndf/precompute/unit_slopes.h"
#include "vndf/stretch.h"
#include "vndf/support/parallel.h"
#include "vndf/table.h"
#include "vndf/vec.h"

namespace vndf::bench {

/// The slopes at u = 0 and u = 1 may be infinite, so the nodes there store those of this u and of 1
/// minus this u, which is the last that float distinguishes from 1.
inline constexpr double kLiteralEnd = 1e-7;

/// Slopes x by theta and u1, and slopes y by x and u2, both row by row.
struct LiteralTables {
  /// Rows and columns of both tables.
  std::size_t side = 0;
  std::vector<float> x, y;

  std::size_t bytes() const { return sizeof(float) * (x.size() + y.size()); }
};

/// Makes the tables of `slopes` with `side` >= 2 nodes on each axis. A row x that no sample reaches
/// repeats the nearest row that samples reach.
std::shared_ptr<const LiteralTables> make_literal_tables(const precompute::UnitSlopes& slopes,
                                                         std::size_t side,
                                                         const support::Workers& workers);

/// Bilinear value of a square table at coordinates in [0, 1].
template <class T>
T bilinear(const std::vector<float>& table, std::size_t side, T row, T column) {
  const Cell<T> r = cell_of(row, side), c = cell_of(column, side);
  const float* p = table.data() + r.index * side + c.index;
  const auto along = [&c](const float* q) {
    const T left = static_cast<T>(q[0]), right = static_cast<T>(q[1]);
    return left + c.fraction * (right - left);
  };
  const T lower = along(p), upper = along(p + side);
  return lower + r.fraction * (upper - lower);
}

/// Samples visible normals from literal tables.
template <class T>
class LiteralSampler {
 public:
  explicit LiteralSampler(std::shared_ptr<const LiteralTables> tables)
      : tables_(std::move(tables)) {}

  /// Draws a normal for `wi`, a unit vector with wi.z >= 0. It may face away from wi, because
  /// slopes interpolated between two rows may exceed the visible ones.
  Vec3<T> sample(const Vec3<T>& wi, const Alpha<T>& alpha, T u1, T u2) const noexcept {
    // 1. stretch
    const Azimuth<T> phi = azimuth(alpha.x * wi.x, alpha.y * wi.y);
    // 2. sample the slopes
    const T x = sample_x(std::atan2(phi.length, wi.z), u1);
    const T y = sample_y(x, u2);
    // 3. rotate, 4. unstretch, 5. compute the normal
    return unstretched_normal(HomogeneousSlope<T>{x, y, T(1)}, phi, alpha);
  }

  /// Step 2.a: the slope x seen from `theta` in [0, pi / 2].
  T sample_x(T theta, T u1) const noexcept {
    return bilinear(tables_->x, tables_->side, theta * (T(2) * std::numbers::inv_pi_v<T>), u1);
  }

  /// Step 2.b: the slope y given x.
  T sample_y(T x, T u2) const noexcept {
    return bilinear(tables_->y, tables_->side, std::atan(x) * std::numbers::inv_pi_v<T> + T(0.5),
                    u2);
  }

 private:
  std::shared_ptr<const LiteralTables> tables_;
};

/// Errors as in a certificate (vndf/certificate.h). They are measured in double precision, because
/// they are far above the rounding of single precision.
struct LiteralErrors {
  double max_u_error = 0;
  double max_density_error = 0;  ///< for u in [1e-6, 1 - 1e-6]
  double tail_ratio = 1;         ///< at 1e-6, the one farthest from 1 of all rows and both ends
};

/// Measures the errors of the slope x off the grid, for u in [1e-9, 1 - 1e-9]. It does not measure
/// y, whose errors depend on our choice of how x is spread over rows.
LiteralErrors measure_literal(const precompute::UnitSlopes& slopes,
                              const std::shared_ptr<const LiteralTables>& tables,
                              const support::Workers& workers);

}  // namespace vndf::bench
