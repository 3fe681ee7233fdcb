// One call of every function of the kernel: what golden vectors record of a device.
#pragma once

#include <cstdint>

#include "vndf/kernel.h"

namespace vndf::devices {

/// The arguments of a sample.
struct KernelInput {
  Vec3<float> wi;
  Alpha<float> alpha;
  float u1, u2;
};

/// The results. D, pdf and the inverse are those of a given normal, so that a device is not blamed
/// in them for the normal that it drew.
struct KernelOutput {
  Vec3<float> wm;    ///< sample()
  float density;     ///< of wm, by sample_with_density()
  float d, pdf;      ///< of the given normal
  float lambda, g1;  ///< of wi
  float u1, u2;      ///< the inverse of the given normal, 0 where there is none
  float found;       ///< 1 where there is an inverse, 0 where there is none
};

/// What the library computes for `input`, with its own normal given.
KernelOutput call_kernel(const Kernel& kernel, const KernelInput& input);

/// A device that rounds as badly as one may, or worse (rough_arithmetic.h).
struct RoughDevice {
  std::uint64_t seed = 0;  ///< another one for another device
  int excess = 1;          ///< its errors in multiples of those that are allowed
};

/// What such a device computes, with `given` as the given normal.
KernelOutput call_rough_kernel(const Kernel& kernel, const KernelInput& input,
                               const Vec3<float>& given, const RoughDevice& device);

}  // namespace vndf::devices
