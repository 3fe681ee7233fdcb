// Refractive indices eta + i k of metals, measured by Johnson and Christy, Optical Constants of the
// Noble Metals, Physical Review B 6 (12), 1972. Red, green and blue are their measurements at 2.01,
// 2.26 and 2.63 eV (617, 549 and 471 nm), which are nearest to the dominant wavelengths of the
// primaries of sRGB (611, 549 and 464 nm).
#pragma once

#include <array>

#include "vndf/bsdf/fresnel.h"

namespace vndf::render {

struct Metal {
  const char* name;
  ConductorFresnel<float, 3> fresnel;
};

inline constexpr std::array<Metal, 3> kMetals{{
    {"copper", {{0.30f, 1.02f, 1.25f}, {3.205f, 2.577f, 2.483f}}},
    {"gold", {{0.21f, 0.43f, 1.31f}, {3.272f, 2.455f, 1.849f}}},
    {"silver", {{0.06f, 0.06f, 0.05f}, {4.152f, 3.586f, 2.869f}}},
}};

}  // namespace vndf::render
