// Writes what a sampler is given and what it returns, for "vndf check".
#include <cmath>
#include <fstream>
#include <random>

#include "vndf/reference/ggx_analytic.h"

int main(int, char** argv) {
  const vndf::GgxAnalytic<float> sampler;  // put yours here
  std::ofstream file(argv[1]);
  file.precision(9);
  file << "wx,wy,wz,ax,ay,u1,u2,mx,my,mz\n";
  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  for (int i = 0; i < 100000; ++i) {
    const float theta = 1.55f * uniform();
    const vndf::Vec3<float> wi{std::sin(theta), 0, std::cos(theta)};
    const vndf::Alpha<float> alpha{0.3f, 0.1f};
    const float u1 = uniform(), u2 = uniform();
    const vndf::Vec3<float> wm = sampler.sample(wi, alpha, u1, u2);
    file << wi.x << ',' << wi.y << ',' << wi.z << ',' << alpha.x << ',' << alpha.y << ',' << u1
         << ',' << u2 << ',' << wm.x << ',' << wm.y << ',' << wm.z << '\n';
  }
}
