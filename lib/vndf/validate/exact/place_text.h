// Places as text, for messages and reports. A surface is told where it is not flat.
#pragma once

#include <string>

#include "vndf/support/text.h"
#include "vndf/validate/exact/configuration.h"

namespace vndf::validate {

/// ", correlation 0.5, mean slope 0.7 x -0.4", with what is not 0.
inline std::string surface_text(const Place& p) {
  using support::rounded_text;
  std::string text;
  if (p.correlation != 0) text += ", correlation " + rounded_text(p.correlation);
  if (p.mean_x != 0 || p.mean_y != 0)
    text += ", mean slope " + rounded_text(p.mean_x) + " x " + rounded_text(p.mean_y);
  return text;
}

/// "theta 60, alpha 2 x 1", and the surface.
inline std::string configuration_text(const Place& p) {
  using support::rounded_text;
  return "theta " + rounded_text(p.theta) + ", alpha " + rounded_text(p.alpha_x) + " x " +
         rounded_text(p.alpha_y) + surface_text(p);
}

}  // namespace vndf::validate
