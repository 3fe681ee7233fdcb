// Stage: conservation of area (Heitz and d'Eon 2014, section 2; Heitz 2014, section 2).
//
//   projected area       int D(wm) wm.z dwm = 1
//   visible area         int dot(wi, wm)+ D(wm) dwm = wi.z / G1(wi)
//
// both with the subject's own D and G1. The second, divided by its right side, is the weak white
// furnace test in the measure of half vectors: a surface without absorption and without shadowing
// reflects what it masks not.
#pragma once

#include <vector>

#include "precompute/parallel.h"
#include "validate/finding.h"
#include "validate/subject.h"

namespace vndf::validate {

std::vector<Finding> test_furnace(const Subject& subject, const precompute::Workers& workers);

}  // namespace vndf::validate
