// What takes the place of the benchmark on a GPU where there is no CUDA compiler.
#include <stdexcept>

#include "vndf/bench/cuda_bench.h"

namespace vndf::bench {

CudaReport run_cuda_bench(const KernelTables&, const CudaOptions&) {
  throw std::runtime_error(
      "this program was built without CUDA; install the CUDA toolkit and build it again with -D "
      "VNDF_BUILD_CUDA=ON");
}

}  // namespace vndf::bench
