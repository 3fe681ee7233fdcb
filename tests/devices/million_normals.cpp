// Writes a million normals of two distributions, and as many on surfaces with correlated slopes and
// a mean slope, with their densities and functions, to a file: from exported headers alone or, with
// VNDF_LIBRARY, from the files of the same tables by the library.
#include <cstdio>
#include <random>
#include <vector>

#ifdef VNDF_LIBRARY
#include "vndf/kernel_tables.h"
#else
#include "ggx.h"
#include "rows.h"
#endif

namespace {

void append_normals(const vndf::Kernel& kernel, std::vector<float>& numbers) {
  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 5.9604644775390625e-8f; };
  for (int i = 0; i < 500000; ++i) {
    const float z = uniform(), slope = uniform(), r = std::sqrt(1 - z * z);
    const float length = std::sqrt(1 + slope * slope);
    const vndf::Vec3<float> wi{r / length, r * slope / length, z};
    const vndf::Alpha<float> alpha{0.01f + uniform(), 0.01f + uniform()};
    const float u1 = uniform(), u2 = uniform();
    const vndf::Vec3<float> wm = kernel.sample(wi, alpha, u1, u2);
    const vndf::RoughSurface<float> surface(alpha, 0.5f, {0.1f, -0.05f});
    const vndf::Vec3<float> tilted = kernel.sample(wi, surface, u1, u2);
    for (const float number :
         {tilted.x, tilted.y, tilted.z, wm.x, wm.y, wm.z,
          kernel.sample_with_density(wi, alpha, u1, u2).pdf, kernel.d(wm, alpha),
          kernel.pdf(wi, wm, alpha), kernel.lambda(wi, alpha), kernel.g1(wi, alpha)})
      numbers.push_back(number);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  std::vector<float> numbers;
#ifdef VNDF_LIBRARY
  for (int i = 2; i < argc; ++i) append_normals(vndf::load(argv[i]).kernel(), numbers);
#else
  append_normals(vndf::ggx_kernel(), numbers);
  append_normals(vndf::rows_kernel(), numbers);
#endif
  std::FILE* file = std::fopen(argv[1], "wb");
  if (!file) return 1;
  const std::size_t written = std::fwrite(numbers.data(), sizeof(float), numbers.size(), file);
  return std::fclose(file) == 0 && written == numbers.size() ? 0 : 1;
}
