// The header for CUDA in a program of somebody else, with its tables where they are and in shared
// memory.
#include "ggx.cuh"

__global__ void sample(const vndf::Vec3<float>* wi, vndf::Vec3<float>* wm) {
  const vndf::Kernel kernel = vndf::ggx_kernel();
  wm[threadIdx.x] = kernel.sample(wi[threadIdx.x], {0.3f, 0.1f}, 0.25f, 0.75f);
}

__global__ void sample_from_shared(const vndf::Vec3<float>* wi, vndf::Vec3<float>* wm) {
  __shared__ alignas(16) unsigned words[sizeof vndf::ggx_words / sizeof(unsigned)];
  for (unsigned i = threadIdx.x; i < sizeof words / sizeof(unsigned); i += blockDim.x)
    words[i] = vndf::ggx_words[i];
  __syncthreads();
  const vndf::Kernel kernel = vndf::ggx_kernel_at(words);
  wm[threadIdx.x] = kernel.sample_with_density(wi[threadIdx.x], {0.3f, 0.1f}, 0.25f, 0.75f).wm;
}
