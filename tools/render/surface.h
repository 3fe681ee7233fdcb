// Rough surfaces by name or from tables, and the ways in which their BSDFs are sampled that Heitz
// and d'Eon 2014 compare. A surface makes materials, so that the path tracer need not know which
// sampler is behind them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/material.h"
#include "vndf/bsdf/fresnel.h"
#include "vndf/kernel_tables.h"
#include "vndf/slope_tables.h"

namespace vndf::render {

/// How a BSDF draws normals.
enum class Sampling {
  previous,  ///< all normals (Algorithm 1)
  walter,    ///< all normals of a surface that is rougher at grazing incidence
  visible    ///< visible normals (Algorithm 2, and 3 for V-cavities)
};

/// Makes materials with the slopes of one distribution. Is shared between threads.
class Surface {
 public:
  virtual ~Surface() = default;

  virtual std::shared_ptr<const Material> metal(
      const Alpha<float>& alpha, const ConductorFresnel<float, 3>& fresnel) const = 0;
  /// `eta` is the refractive index of the glass over that of air.
  virtual std::shared_ptr<const Material> glass(const Alpha<float>& alpha, float eta) const = 0;
};

/// The names of the surfaces that need no tables.
std::vector<std::string> analytic_surfaces();

/// A surface by the name of its reference sampler. Throws std::invalid_argument for an unknown
/// name, with the nearest known one.
std::shared_ptr<const Surface> analytic_surface(const std::string& name, Sampling sampling);

/// The surface of baked tables, or of a pair.
std::shared_ptr<const Surface> tabulated_surface(std::shared_ptr<const KernelTables> tables,
                                                 Sampling sampling);
std::shared_ptr<const Surface> tabulated_surface(std::shared_ptr<const SlopeTables> tables,
                                                 Sampling sampling);

}  // namespace vndf::render
