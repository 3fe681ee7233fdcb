// Runs the kernel on a GPU with its tables in global, constant and shared memory.
#include "vndf/bench/cuda_bench.h"

#include <cuda_runtime.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>

#include "vndf/devices/golden_vectors.h"
#include "vndf/kernel.h"

namespace vndf::bench {
namespace {

using devices::KernelInput;
using devices::KernelOutput;

void require(cudaError_t status) {
  if (status != cudaSuccess)
    throw std::runtime_error(std::string("CUDA: ") + cudaGetErrorString(status) +
                             "; run it on a machine with a CUDA device that is free");
}

/// Memory on the device.
template <class T>
class DeviceArray {
 public:
  explicit DeviceArray(std::size_t count) : count_(count) {
    void* p = nullptr;
    require(cudaMalloc(&p, count * sizeof(T)));
    data_.reset(static_cast<T*>(p));
  }
  explicit DeviceArray(const std::vector<T>& values) : DeviceArray(values.size()) {
    require(cudaMemcpy(get(), values.data(), count_ * sizeof(T), cudaMemcpyHostToDevice));
  }
  T* get() const { return data_.get(); }
  std::vector<T> values() const {
    std::vector<T> result(count_);
    require(cudaMemcpy(result.data(), get(), count_ * sizeof(T), cudaMemcpyDeviceToHost));
    return result;
  }

 private:
  struct Free {
    void operator()(T* p) const { cudaFree(p); }
  };
  std::size_t count_;
  std::unique_ptr<T, Free> data_;
};

// What the kernel computes on the device.

__global__ void call_on_device(kernel::VndfTables t, const KernelInput* inputs,
                               const Vec3<float>* given, KernelOutput* outputs, int count) {
  const int i = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  if (i >= count) return;
  const Kernel k(t);
  const KernelInput in = inputs[i];
  const Vec3<float> wm = given[i];
  const bool valid = kernel::vndf_valid(in.wi, in.alpha.x, in.alpha.y) && wm.z > 0.0f;
  const kernel::VndfInverse inverse =
      kernel::vndf_invert(t, kernel::vndf_at(t, in.wi, in.alpha.x, in.alpha.y), wm);
  const bool found = valid && inverse.found;
  outputs[i] = {k.sample(in.wi, in.alpha, in.u1, in.u2),
                k.sample_with_density(in.wi, in.alpha, in.u1, in.u2).pdf,
                k.d(wm, in.alpha),
                k.pdf(in.wi, wm, in.alpha),
                k.lambda(in.wi, in.alpha),
                k.g1(in.wi, in.alpha),
                found ? inverse.u1 : 0.0f,
                found ? inverse.u2 : 0.0f,
                found ? 1.0f : 0.0f};
}

/// The tables with their block at `bytes`.
kernel::VndfTables tables_at(const KernelTables& tables, const void* bytes) {
  kernel::VndfTables t = tables.kernel().tables();
  t.block.bytes = static_cast<const unsigned char*>(bytes);
  return t;
}

constexpr unsigned kThreads = 256;

void check_golden_vectors(const KernelTables& tables, const DeviceArray<std::byte>& block,
                          std::size_t count, CudaReport& report) {
  const auto golden = devices::golden_vectors(tables.kernel(), count);
  std::vector<KernelInput> inputs;
  std::vector<Vec3<float>> given;
  for (const devices::GoldenVector& vector : golden) {
    inputs.push_back(vector.input);
    given.push_back(vector.output.wm);
  }
  const DeviceArray<KernelInput> device_inputs(inputs);
  const DeviceArray<Vec3<float>> device_given(given);
  const DeviceArray<KernelOutput> device_outputs(count);
  const auto blocks = static_cast<unsigned>((count + kThreads - 1) / kThreads);
  call_on_device<<<blocks, kThreads>>>(tables_at(tables, block.get()), device_inputs.get(),
                                       device_given.get(), device_outputs.get(),
                                       static_cast<int>(count));
  require(cudaGetLastError());
  const std::vector<KernelOutput> outputs = device_outputs.values();
  report.golden_vectors = count;
  for (std::size_t i = 0; i < count; ++i)
    if (const char* name = devices::first_difference(golden[i], outputs[i]))
      if (report.golden_failures++ == 0)
        report.first_failure = std::string(name) + " of vector " + std::to_string(i);
}

// How fast it is.

/// A direction and a roughness.
struct View {
  Vec3<float> wi;
  Alpha<float> alpha;
};

/// Visible GGX normals by spherical caps (Dupuy and Benyoub 2023), with the functions of the GPU.
struct Caps {
  __device__ Vec3<float> operator()(const View& view, float u1, float u2) const {
    const auto [wi, alpha] = view;
    const float x = alpha.x * wi.x, y = alpha.y * wi.y;
    const float scale = rsqrtf(x * x + y * y + wi.z * wi.z);
    const Vec3<float> w{x * scale, y * scale, wi.z * scale};
    const float z = (1.0f - u2) * (1.0f + w.z) - w.z;
    const float horizontal = sqrtf(fminf(fmaxf(1.0f - z * z, 0.0f), 1.0f));
    float sine, cosine;
    sincospif(2.0f * u1, &sine, &cosine);
    const Vec3<float> m{alpha.x * (horizontal * cosine + w.x), alpha.y * (horizontal * sine + w.y),
                        z + w.z};
    const float length = rsqrtf(m.x * m.x + m.y * m.y + m.z * m.z);
    return {m.x * length, m.y * length, m.z * length};
  }
};

/// The kernel, with its tables where `bytes` is.
struct Tables {
  Kernel kernel;
  __device__ Vec3<float> operator()(const View& view, float u1, float u2) const {
    return kernel.sample(view.wi, view.alpha, u1, u2);
  }
};

/// Adds up normals, so that no compiler leaves them out. Every thread takes `count` samples; one
/// view serves all if `views` is 1. u is a Weyl sequence, which costs next to nothing.
template <class Sampler>
__device__ void draw(const Sampler& sampler, const View* views, unsigned view_count, int count,
                     float* sums) {
  const unsigned thread = blockIdx.x * blockDim.x + threadIdx.x;
  unsigned state1 = thread * 2654435769u, state2 = thread * 1640531527u;
  float sum = 0;
  for (int k = 0; k < count; ++k) {
    state1 += 3242174889u;
    state2 += 2447445413u;
    const View& view = views[(thread + static_cast<unsigned>(k) * 131071u) & (view_count - 1)];
    const Vec3<float> m = sampler(view, static_cast<float>(state1 >> 8) * 0x1p-24f,
                                  static_cast<float>(state2 >> 8) * 0x1p-24f);
    sum += m.x + m.y + m.z;
  }
  sums[thread] = sum;
}

/// What fits beside the arguments of kernels into the 64 KiB of constant memory.
constexpr std::size_t kConstantBytes = 60 * 1024;
__constant__ uint4 constant_block[kConstantBytes / sizeof(uint4)];

__global__ void draw_caps(const View* views, unsigned view_count, int count, float* sums) {
  draw(Caps(), views, view_count, count, sums);
}

__global__ void draw_global(kernel::VndfTables t, const View* views, unsigned view_count, int count,
                            float* sums) {
  draw(Tables{Kernel(t)}, views, view_count, count, sums);
}

__global__ void draw_constant(kernel::VndfTables t, const View* views, unsigned view_count,
                              int count, float* sums) {
  t.block.bytes = reinterpret_cast<const unsigned char*>(constant_block);
  draw(Tables{Kernel(t)}, views, view_count, count, sums);
}

__global__ void draw_shared(kernel::VndfTables t, unsigned words, const View* views,
                            unsigned view_count, int count, float* sums) {
  extern __shared__ uint4 shared_block[];
  const uint4* from = reinterpret_cast<const uint4*>(t.block.bytes);
  for (unsigned i = threadIdx.x; i < words; i += blockDim.x) shared_block[i] = from[i];
  __syncthreads();
  t.block.bytes = reinterpret_cast<const unsigned char*>(shared_block);
  draw(Tables{Kernel(t)}, views, view_count, count, sums);
}

/// One sampler: how it is started for views, of which there are a power of two, and its function.
struct CudaCase {
  CudaEntry entry;
  std::function<void(const View* views, unsigned view_count)> start;
  std::vector<double> coherent, random;  ///< samples per second in each round
};

template <class Function>
CudaEntry entry_of(const char* name, Function function) {
  cudaFuncAttributes attributes{};
  require(cudaFuncGetAttributes(&attributes, function));
  CudaEntry entry;
  entry.name = name;
  entry.registers = attributes.numRegs;
  entry.spilled_bytes = attributes.localSizeBytes;
  return entry;
}

std::vector<View> random_views(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<View> views;
  for (std::size_t i = 0; i < count; ++i) {
    const float z = uniform(random), phi = 6.2831853f * uniform(random);
    const float r = std::sqrt(1 - z * z);
    views.push_back({{r * std::cos(phi), r * std::sin(phi), z},
                     {0.05f + uniform(random), 0.05f + uniform(random)}});
  }
  return views;
}

/// Threads of a grid that fills the device, and the samples of each.
constexpr unsigned kBlocks = 4096;
constexpr std::size_t kGrid = std::size_t{kBlocks} * kThreads;

class CudaTimer {
 public:
  CudaTimer() {
    require(cudaEventCreate(&begin_));
    require(cudaEventCreate(&end_));
  }
  ~CudaTimer() {
    cudaEventDestroy(begin_);
    cudaEventDestroy(end_);
  }
  CudaTimer(const CudaTimer&) = delete;
  CudaTimer& operator=(const CudaTimer&) = delete;

  double seconds(const std::function<void()>& work) {
    require(cudaEventRecord(begin_));
    work();
    require(cudaGetLastError());
    require(cudaEventRecord(end_));
    require(cudaEventSynchronize(end_));
    float milliseconds = 0;
    require(cudaEventElapsedTime(&milliseconds, begin_, end_));
    return 1e-3 * static_cast<double>(milliseconds);
  }

 private:
  cudaEvent_t begin_{}, end_{};
};

std::vector<CudaCase> cases_of(const KernelTables& tables, const DeviceArray<std::byte>& block,
                               int count, float* sums) {
  const kernel::VndfTables t = tables_at(tables, block.get());
  const std::size_t words = (tables.bytes().size() + sizeof(uint4) - 1) / sizeof(uint4);
  const std::size_t bytes = words * sizeof(uint4);
  std::vector<CudaCase> cases;
  cases.push_back({entry_of("caps", draw_caps), [=](const View* views, unsigned n) {
                     draw_caps<<<kBlocks, kThreads>>>(views, n, count, sums);
                   }});
  cases.push_back(
      {entry_of("tables in global memory", draw_global), [=](const View* views, unsigned n) {
         draw_global<<<kBlocks, kThreads>>>(t, views, n, count, sums);
       }});
  if (bytes <= kConstantBytes) {
    require(cudaMemcpyToSymbol(constant_block, tables.bytes().data(), tables.bytes().size()));
    cases.push_back(
        {entry_of("tables in constant memory", draw_constant), [=](const View* views, unsigned n) {
           draw_constant<<<kBlocks, kThreads>>>(t, views, n, count, sums);
         }});
  }
  int most_shared = 0;
  require(cudaDeviceGetAttribute(&most_shared, cudaDevAttrMaxSharedMemoryPerBlockOptin, 0));
  if (bytes <= static_cast<std::size_t>(most_shared)) {
    require(cudaFuncSetAttribute(draw_shared, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                 static_cast<int>(bytes)));
    cases.push_back(
        {entry_of("tables in shared memory", draw_shared), [=](const View* views, unsigned n) {
           draw_shared<<<kBlocks, kThreads, bytes>>>(t, static_cast<unsigned>(words), views, n,
                                                     count, sums);
         }});
  }
  return cases;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

}  // namespace

CudaReport run_cuda_bench(const KernelTables& tables, const CudaOptions& options) {
  cudaDeviceProp properties{};
  require(cudaGetDeviceProperties(&properties, 0));
  CudaReport report;
  report.device = properties.name;

  std::vector<std::byte> bytes(tables.bytes().begin(), tables.bytes().end());
  bytes.resize((bytes.size() + sizeof(uint4) - 1) / sizeof(uint4) * sizeof(uint4));
  const DeviceArray<std::byte> block(bytes);
  check_golden_vectors(tables, block, options.golden_vectors, report);

  constexpr unsigned kViews = 1u << 20;
  const DeviceArray<View> views(random_views(kViews));
  const DeviceArray<float> sums(kGrid);
  const int count = static_cast<int>(std::max<std::size_t>(options.samples / kGrid, 1));
  const double samples = static_cast<double>(count) * static_cast<double>(kGrid);
  std::vector<CudaCase> cases = cases_of(tables, block, count, sums.get());
  CudaTimer timer;
  for (int round = -1; round < options.rounds; ++round)  // the first warms up
    for (CudaCase& c : cases) {
      const double coherent = samples / timer.seconds([&] { c.start(views.get(), 1); });
      const double random = samples / timer.seconds([&] { c.start(views.get(), kViews); });
      if (round < 0) continue;
      c.coherent.push_back(coherent);
      c.random.push_back(random);
    }
  for (CudaCase& c : cases) {
    c.entry.coherent = median(c.coherent);
    c.entry.random = median(c.random);
    report.entries.push_back(c.entry);
  }
  return report;
}

}  // namespace vndf::bench
