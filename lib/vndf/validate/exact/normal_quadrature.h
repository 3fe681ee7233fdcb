// Quadrature over the hemisphere of normals, in polar stretched slopes: Gauss's rule in panels of
// asinh(r), graded towards the pole, the breaks of p22 and the cotangent of incidence, and over
// the azimuths that are seen. It meets no singularity at any anisotropy or incidence.
#pragma once

#include <vector>

#include "vndf/validate/exact/exact_distribution.h"

namespace vndf::validate {

/// The largest error of the integral of a density over the nodes, for the distributions shipped.
inline constexpr double kQuadratureError = 1e-6;

struct NormalQuadrature {
  std::vector<Vec3<double>> wm;
  std::vector<double> weight;  ///< solid angle
  /// Mass that the distribution has in the part of the hemisphere that the nodes cover: a heavy
  /// tail is cut where single-precision normals cannot carry it.
  double covered = 1;
};

/// Nodes for the densities of `kind` at `configuration`: those that are seen from wi, or all.
NormalQuadrature normal_quadrature(const ExactSlopes& exact, SampledNormals kind,
                                   const Configuration& configuration);

}  // namespace vndf::validate
