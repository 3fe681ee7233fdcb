// Weights of sampled reflections over the unit square of random numbers (Heitz and d'Eon 2014,
// Figure 4 and Table 2), which show why visible normals are worth sampling. For facets that reflect
// everything the weight is f |wo.z| / pdf(wo):
//
//   visible normals (Algorithm 2)                  G2 / G1(wi)
//   all normals (Algorithm 1, previous method)     dot(wi, wm)+ G2 / (wi.z wm.z)
//
// Both have the same mean, the reflectance that is left after shadowing.
#pragma once

#include "vndf/validate/pictures/grid.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// Weights with u1 to the right and u2 up, each at a point of its cell.
struct SampleWeights {
  Grid weight;
  double largest = 0, mean = 0;
  double lost = 0;  ///< part of the samples that have weight 0
};

/// The weights of the normals that the sampler draws, in `cells` x `cells`. Valid for wi.z > 0.
SampleWeights sample_weights(const SamplerUnderTest& sampler, const Configuration& configuration,
                             std::size_t cells);

/// The weights of Algorithm 1 on the same surface: all normals, as the sampler draws them at normal
/// incidence, where all are visible. Valid for wi.z > 0.
SampleWeights previous_weights(const SamplerUnderTest& sampler, const Configuration& configuration,
                               std::size_t cells);

}  // namespace vndf::validate
