// From a specification to a slope distribution, and back. A file of tables carries a specification
// (vndf/provenance.h), so every program that reads the file can make the distribution again. The
// text is one line:
//
//   student-t:gamma=3                        a named family or mixture (parse_distribution.h)
//   p22:'exp(-k*r^2)' param:k=2.5 break:1    a slope density p22(r), its parameters and jumps
//   ndf:'alpha^2/(cos(theta)^2*(alpha^2-1)+1)^2'    a normal distribution D(theta, alpha)
//   ndf:'cos(theta)^(2/alpha^2-2)' frozen-at:0.3    its surface of alpha = 0.3 as the shape
//   profile tail:power=4.2                   samples of p22(r), which stand beside the text
//
// Each may be followed by name:'...', the name that people see. Items are separated by single
// spaces. Within quotes a single quote is written twice. Numbers are the shortest decimals that
// read back as the same float64, so that the distribution is the same bit for bit.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vndf/distributions/compiled_formula.h"
#include "vndf/distributions/measured_profile.h"
#include "vndf/distributions/slope_distribution.h"
#include "vndf/provenance.h"

namespace vndf::distributions {

/// Longest name in bytes, so that a name fits into a line.
inline constexpr std::size_t kMaxNameLength = 200;

/// Specifies a named family or mixture, with every parameter written out. Throws
/// std::invalid_argument as parse_distribution() does, and for a name longer than kMaxNameLength.
/// An empty `name` is none. Both hold below, too.
Specification specify_family(const std::string& text, const std::string& name = {});

/// Specifies a density p22(r), with the radii at which it jumps or has a kink. Throws
/// std::invalid_argument for a formula that is wrong, a break that is not a finite number > 0, and
/// a name or formula with a control character.
Specification specify_p22(const Formula& formula, const std::vector<double>& breaks = {},
                          const std::string& name = {});

/// Specifies a normal distribution D(theta) or D(theta, alpha). `frozen_at` is the alpha of the
/// surface that is taken as the shape; without it alpha may only stretch the surface. Throws
/// std::invalid_argument as specify_p22() does, and for `frozen_at` where D does not use alpha.
Specification specify_ndf(const Formula& formula, std::optional<double> frozen_at = {},
                          const std::vector<double>& breaks = {}, const std::string& name = {});

/// Specifies a profile by its samples, its name and its tail with the fitted parameter. Throws
/// std::invalid_argument for a name with a control character.
Specification specify_profile(const MeasuredProfile& profile);

/// Makes the distribution and diagnoses it. It is the same bit for bit wherever it is made. Throws
/// std::invalid_argument, one line that says what is wrong and where, for a text outside of the
/// grammar and for samples that are missing, are not a profile or belong to another kind; and
/// std::domain_error for a distribution that diagnose(), require_shape_invariant() or
/// MeasuredProfile refuses.
std::unique_ptr<SlopeDistribution> make_distribution(const Specification& specification);

}  // namespace vndf::distributions
