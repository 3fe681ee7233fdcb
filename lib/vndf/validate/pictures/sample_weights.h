// Weights of sampled reflections over the unit square of random numbers (Heitz and d'Eon 2014,
// Figure 4 and Table 2), for facets that reflect everything: f |wo.z| / pdf(wo), by the sampler and
// by the previous method.
//
//   visible normals (Algorithm 2)   G2 / G1(wi)
//   all normals (Algorithm 1)       dot(wi, wm)+ G2 / (wi.z wm.z)
//
// Both have the same mean, the reflectance that is left after shadowing.
#pragma once

#include "vndf/validate/pictures/grid.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// u1 to the right and u2 up, at a point of each cell.
struct SampleWeights {
  Grid weight;
  double largest = 0, mean = 0;
  double lost = 0;  ///< part of the samples that have weight 0
};

/// Weights of the normals that the sampler draws. Valid: wi.z > 0.
SampleWeights sample_weights(const SamplerUnderTest& sampler, const Configuration& configuration,
                             std::size_t cells);

/// Weights of Algorithm 1 on the same surface: all normals, drawn by the sampler at normal
/// incidence, where all are visible.
SampleWeights previous_weights(const SamplerUnderTest& sampler, const Configuration& configuration,
                               std::size_t cells);

}  // namespace vndf::validate
