// Furnace check: conservation of area and of energy (Heitz and d'Eon 2014, section 2; Heitz 2014,
// section 2). A surface that sends out more than comes in makes light in every bounce.
//
//   projected area       int D(wm) wm.z dwm = 1
//   visible area         int dot(wi, wm)+ D(wm) dwm = wi.z / G1(wi), and |wi.z| Lambda(wi) below
//   reciprocity          G2(wi, wo, wm) = G2(wo, wi, wm), above and below the horizon
//   energy               int f(wi, wo) |wo.z| dwo <= 1, for facets of a perfect mirror and of glass
//
// all with the sampler's own D, Lambda and G1; wi.z and wo.z stand for what the mean facet shows to
// the direction. The second, divided by its right side, is the weak white
// furnace test in the measure of half vectors: a surface that absorbs nothing and has no shadowing
// reflects all that it does not mask. With shadowing the rest is light that would be scattered
// again, so that the energy may be less than 1, never more.
#pragma once

#include <vector>

#include "vndf/support/parallel.h"
#include "vndf/validate/sampler/sampler_under_test.h"
#include "vndf/validate/statistics/check_result.h"

namespace vndf::validate {

/// The largest difference of G2 when wi and wo are exchanged: the rounding of single precision.
inline constexpr double kReciprocityError = 2e-6;

/// The largest error of each over check_configurations(), with the bounds Bounds::function_error
/// and kReciprocityError. The visible area is left out for V-cavities, whose G1 is another.
std::vector<CheckResult> check_furnace(const SamplerUnderTest& sampler,
                                       const support::Workers& workers);

}  // namespace vndf::validate
