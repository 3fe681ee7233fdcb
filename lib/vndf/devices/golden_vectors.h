// Golden vectors: inputs of the kernel with what it must give, for the authors of ports to devices
// and languages that we do not know. Half of the inputs are random and half hard: the pole and next
// to it, grazing, small and large roughness, u at its ends and at one half, and inputs outside
// their range.
//
// A tolerance stands beside every number. It is twice the largest difference that sixteen devices
// show which round four times worse than one may (rough_arithmetic.h), and at least four units in
// the last place: enough for a correct port, and too little for a wrong one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vndf/devices/kernel_calls.h"
#include "vndf/kernel_tables.h"

namespace vndf::devices {

/// Largest differences. That of wm is the length of the difference of the two vectors, which is the
/// angle between them for small ones; those of the others are absolute.
struct KernelTolerance {
  float wm, density, d, pdf, lambda, g1, u1, u2, found;
};

struct GoldenVector {
  KernelInput input;
  KernelOutput output;
  KernelTolerance tolerance;
};

/// The first `count` inputs of the sequence that all golden vectors share.
std::vector<KernelInput> golden_inputs(std::size_t count);

/// What `kernel` gives for one input, with tolerances.
GoldenVector golden_vector(const Kernel& kernel, const KernelInput& input);

/// The golden vectors of `kernel`.
std::vector<GoldenVector> golden_vectors(const Kernel& kernel, std::size_t count);

/// Returns the name of the first result in `output` that is not within its tolerance, or nullptr.
/// Two equal infinite results agree.
const char* first_difference(const GoldenVector& golden, const KernelOutput& output);

/// `vectors` as CSV: lines of explanation that begin with '#', a line of names, and a line for each
/// vector with nine digits a number, from which the same numbers are read.
std::string golden_csv(const KernelTables& tables, const std::vector<GoldenVector>& vectors);

}  // namespace vndf::devices
