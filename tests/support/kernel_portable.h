// The kernel as compilers without vectors of four compile it, which is to give the same bits.
#pragma once

#include <array>

namespace vndf::test {

/// wi, alpha, u1, u2.
using KernelInput = std::array<float, 7>;
/// wm and pdf of sample_with_density(), D and Lambda of wm.
using KernelAnswers = std::array<float, 6>;

/// Of the portable code. `tables` are kernel::VndfTables, which have the same bytes in both.
KernelAnswers portable_answers(const void* tables, const KernelInput& input);

/// The calls behind the answers, of either code.
template <class Kernel, class Vec, class Alpha>
KernelAnswers answers_of(const Kernel& kernel, const KernelInput& in) {
  const Vec wi{in[0], in[1], in[2]};
  const Alpha alpha{in[3], in[4]};
  const auto sampled = kernel.sample_with_density(wi, alpha, in[5], in[6]);
  return {sampled.wm.x,
          sampled.wm.y,
          sampled.wm.z,
          sampled.pdf,
          kernel.d(sampled.wm, alpha),
          kernel.lambda(sampled.wm, alpha)};
}

}  // namespace vndf::test
