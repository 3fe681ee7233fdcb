// Rough surfaces by name or from tables.
#include "render/surface.h"

#include <functional>
#include <stdexcept>
#include <utility>

#include "vndf/bsdf/all_normals.h"
#include "vndf/bsdf/conductor_brdf.h"
#include "vndf/bsdf/dielectric_bsdf.h"
#include "vndf/reference/beckmann_analytic.h"
#include "vndf/reference/beckmann_exact.h"
#include "vndf/reference/beckmann_ndf.h"
#include "vndf/reference/ggx_analytic.h"
#include "vndf/reference/ggx_caps.h"
#include "vndf/reference/ggx_exact.h"
#include "vndf/reference/ggx_hemisphere.h"
#include "vndf/reference/ggx_ndf.h"
#include "vndf/reference/v_cavity.h"
#include "vndf/reference/walter_roughness.h"
#include "vndf/support/text.h"
#include "vndf/tabulated_sampler.h"

namespace vndf::render {
namespace {

/// Keeps what a sampler refers to.
using Owner = std::shared_ptr<const void>;

template <class Sampler, class Masking>
class RoughMetal final : public Material {
 public:
  RoughMetal(Owner owner, const Sampler& sampler, const Alpha<float>& alpha,
             const ConductorFresnel<float, 3>& fresnel)
      : owner_(std::move(owner)), sampler_(sampler), brdf_(sampler_, alpha, fresnel) {}

  Rgb evaluate(const Vector& wi, const Vector& wo) const override {
    return rgb(brdf_.evaluate(wi, wo));
  }
  float pdf(const Vector& wi, const Vector& wo) const override { return brdf_.pdf(wi, wo); }
  Scattered sample(const Vector& wi, const Vec2<float>& u, float) const override {
    const auto drawn = brdf_.sample(wi, u.x, u.y);
    return {drawn.wo, rgb(drawn.weight), drawn.pdf};
  }

 private:
  static Rgb rgb(const std::array<float, 3>& c) { return {c[0], c[1], c[2]}; }

  Owner owner_;
  Sampler sampler_;
  ConductorBrdf<Sampler, ConductorFresnel<float, 3>, Masking> brdf_;
};

/// The radiance of light that enters glass grows by eta^2 and falls by as much where it leaves.
/// All light of our scenes is outside, so both factors are left out.
template <class Sampler, class Masking>
class RoughGlass final : public Material {
 public:
  RoughGlass(Owner owner, const Sampler& sampler, const Alpha<float>& alpha, float eta)
      : owner_(std::move(owner)), sampler_(sampler), bsdf_(sampler_, alpha, eta) {}

  Rgb evaluate(const Vector& wi, const Vector& wo) const override {
    return grey(bsdf_.evaluate(wi, wo));
  }
  float pdf(const Vector& wi, const Vector& wo) const override { return bsdf_.pdf(wi, wo); }
  Scattered sample(const Vector& wi, const Vec2<float>& u, float u3) const override {
    const auto drawn = bsdf_.sample(wi, u.x, u.y, u3);
    return {drawn.wo, grey(drawn.weight), drawn.pdf};
  }

 private:
  static Rgb grey(float value) { return {value, value, value}; }

  Owner owner_;
  Sampler sampler_;
  DielectricBsdf<Sampler, Masking> bsdf_;
};

template <class Sampler, class Masking>
class SurfaceOf final : public Surface {
 public:
  SurfaceOf(Owner owner, const Sampler& sampler) : owner_(std::move(owner)), sampler_(sampler) {}

  std::shared_ptr<const Material> metal(const Alpha<float>& alpha,
                                        const ConductorFresnel<float, 3>& fresnel) const override {
    return std::make_shared<RoughMetal<Sampler, Masking>>(owner_, sampler_, alpha, fresnel);
  }
  std::shared_ptr<const Material> glass(const Alpha<float>& alpha, float eta) const override {
    return std::make_shared<RoughGlass<Sampler, Masking>>(owner_, sampler_, alpha, eta);
  }

 private:
  Owner owner_;
  Sampler sampler_;
};

template <class Masking, class Visible, class All>
std::shared_ptr<const Surface> surface_of(Owner owner, const Visible& visible, const All& all,
                                          Sampling sampling) {
  switch (sampling) {
    case Sampling::previous:
      return std::make_shared<SurfaceOf<All, Masking>>(std::move(owner), all);
    case Sampling::walter:
      return std::make_shared<SurfaceOf<WalterRoughness<All>, Masking>>(std::move(owner),
                                                                        WalterRoughness<All>(all));
    case Sampling::visible:
      break;
  }
  return std::make_shared<SurfaceOf<Visible, Masking>>(std::move(owner), visible);
}

/// A surface of Smith's model. All its normals are drawn by the same sampler as the visible ones.
template <class Visible>
std::shared_ptr<const Surface> smith_surface(Owner owner, const Visible& visible,
                                             Sampling sampling) {
  return surface_of<SmithCorrelated>(std::move(owner), visible, AllNormals<Visible>(visible),
                                     sampling);
}

template <class Visible>
std::shared_ptr<const Surface> smith(Sampling sampling) {
  return smith_surface({}, Visible{}, sampling);
}

template <class All>
std::shared_ptr<const Surface> v_cavities(Sampling sampling) {
  return surface_of<VCavityMasking>({}, VCavity<All>{}, All{}, sampling);
}

struct Named {
  const char* name;
  std::function<std::shared_ptr<const Surface>(Sampling)> make;
};

const std::vector<Named>& named_surfaces() {
  static const std::vector<Named> list{
      {"ggx-caps", smith<GgxCaps<float>>},
      {"ggx-exact", smith<GgxExact<float>>},
      {"ggx-analytic", smith<GgxAnalytic<float>>},
      {"ggx-hemisphere", smith<GgxHemisphere<float>>},
      {"beckmann-exact", smith<BeckmannExact<float>>},
      {"beckmann-analytic", smith<BeckmannAnalytic<float>>},
      {"ggx-v-cavity", v_cavities<GgxNdf<float>>},
      {"beckmann-v-cavity", v_cavities<BeckmannNdf<float>>},
  };
  return list;
}

}  // namespace

std::vector<std::string> analytic_surfaces() {
  std::vector<std::string> names;
  for (const Named& named : named_surfaces()) names.emplace_back(named.name);
  return names;
}

std::shared_ptr<const Surface> analytic_surface(const std::string& name, Sampling sampling) {
  for (const Named& named : named_surfaces())
    if (named.name == name) return named.make(sampling);
  const auto known = analytic_surfaces();
  throw std::invalid_argument(
      "'" + name + "' is neither a table file nor a sampler of visible normals" +
      support::did_you_mean(name, known) + "; known: " + support::listed(known));
}

std::shared_ptr<const Surface> tabulated_surface(std::shared_ptr<const KernelTables> tables,
                                                 Sampling sampling) {
  const Kernel kernel = tables->kernel();
  return smith_surface(std::move(tables), kernel, sampling);
}

std::shared_ptr<const Surface> tabulated_surface(std::shared_ptr<const SlopeTables> tables,
                                                 Sampling sampling) {
  return smith_surface({}, TabulatedSampler<float>(std::move(tables)), sampling);
}

}  // namespace vndf::render
