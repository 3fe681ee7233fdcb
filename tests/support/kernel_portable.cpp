// The kernel as compilers without vectors of four compile it.
#include "support/kernel_portable.h"

#include <cstring>

// In a namespace of its own, for its functions have the names of the others.
#define VNDF_PORTABLE
#define vndf vndf_portable
#include "vndf/kernel.h"
#undef vndf

namespace vndf::test {

KernelAnswers portable_answers(const void* tables, const KernelInput& input) {
  vndf_portable::kernel::VndfTables own;
  std::memcpy(&own, tables, sizeof own);
  return answers_of<vndf_portable::Kernel, vndf_portable::Vec3<float>, vndf_portable::Alpha<float>>(
      vndf_portable::Kernel(own), input);
}

}  // namespace vndf::test
