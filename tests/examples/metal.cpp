#include <iostream>

#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/kernel_tables.h"

int main(int, char** argv) {
  const vndf::KernelTables tables = vndf::load(argv[1]);
  const vndf::Kernel ggx = tables.kernel();
  // eta and k of red, green and blue.
  const vndf::ConductorFresnel gold{{0.14f, 0.37f, 1.44f}, {4.1f, 2.3f, 1.8f}};
  const vndf::ConductorBrdf metal(ggx, {0.3f, 0.1f}, gold);
  const auto drawn = metal.sample({0.6f, 0.0f, 0.8f}, 0.25f, 0.75f);
  std::cout << "wo     = " << drawn.wo.x << ' ' << drawn.wo.y << ' ' << drawn.wo.z << '\n'
            << "weight = " << drawn.weight[0] << ' ' << drawn.weight[1] << ' ' << drawn.weight[2]
            << '\n'
            << "pdf    = " << drawn.pdf << '\n';
}
