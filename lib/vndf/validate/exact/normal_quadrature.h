// Quadrature over the hemisphere of normals, which gives the integrals of a sampler's own density
// and of its BSDFs. The nodes are polar stretched slopes: Gauss's rule in panels of asinh(r),
// graded towards the pole, the breaks of p22 and the cotangent of incidence, and over the azimuths
// that are seen. The integrands are smooth between these places at any anisotropy and incidence.
//
// The table builder integrates over Cartesian slopes with nodes of its own. What it
// shares is the mean slope, in which slopes are measured, and p22 and the projected area, which
// only say how far the nodes reach.
#pragma once

#include <vector>

#include "vndf/validate/exact/exact_distribution.h"

namespace vndf::validate {

/// The largest error of the integral of an exact density over the nodes, for every distribution
/// that the toolkit names.
inline constexpr double kQuadratureError = 1e-6;

/// The sum of f(wm) times weight is the integral of f over the normals.
struct NormalQuadrature {
  std::vector<Vec3<double>> wm;
  std::vector<double> weight;  ///< the solid angle that each stands for
  /// The exact mass of the part of the hemisphere that the nodes cover. A heavy tail is cut where
  /// normals of single precision cannot carry it.
  double covered = 1;
};

/// The nodes for the densities of `kind` at `configuration`: the normals that are seen from wi, or
/// all of them.
NormalQuadrature normal_quadrature(const ExactSlopes& exact, SampledNormals kind,
                                   const Configuration& configuration);

}  // namespace vndf::validate
