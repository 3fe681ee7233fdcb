#include <iostream>

#include "vndf/kernel_tables.h"
#include "vndf/on_surface.h"

int main(int, char** argv) {
  const vndf::KernelTables tables = vndf::load(argv[1]);
  const auto mapped = tables.text().provenance.surface;
  if (!mapped) throw vndf::KernelTablesError("these tables are not of a map");
  const vndf::Kernel bumps = tables.kernel();
  const vndf::OnSurface surface(bumps, mapped->surface<float>());
  const vndf::Vec3<float> wi{0.6f, 0.0f, 0.8f};
  const vndf::Vec3<float> wm = surface.sample(wi, 0.25f, 0.75f);
  std::cout << "wm  = " << wm.x << ' ' << wm.y << ' ' << wm.z << '\n'
            << "pdf = " << surface.pdf(wi, wm) << '\n';
}
