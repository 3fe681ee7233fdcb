#include <iostream>

#include "vndf/kernel_tables.h"

int main(int, char** argv) {
  const vndf::KernelTables tables = vndf::load(argv[1], {.max_u_error = 1e-5});
  const vndf::Kernel ggx = tables.kernel();
  const vndf::Vec3<float> wi{0.6f, 0.0f, 0.8f};
  const vndf::Alpha<float> alpha{0.3f, 0.1f};
  const vndf::Vec3<float> wm = ggx.sample(wi, alpha, 0.25f, 0.75f);
  std::cout << "wm  = " << wm.x << ' ' << wm.y << ' ' << wm.z << '\n'
            << "pdf = " << ggx.pdf(wi, wm, alpha) << '\n'
            << "G1  = " << ggx.g1(wi, alpha) << '\n';
}
