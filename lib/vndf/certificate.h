// The measured errors of tables, which their file carries. Every figure is measured of the sampler
// and the functions as a renderer runs them, in single precision, at points off the table's grid.
//
// A u-error is |CDF(x(u)) - u|, with the exact CDF of the slope x that was sampled for u. Its
// largest value bounds the Kolmogorov distance of the sampled distribution from the exact one.
#pragma once

#include <string>

namespace vndf {

/// Sampled mass of a tail over its exact mass, P(CDF < e) / e, at e = 1e-4, 1e-5 and 1e-6. Each is
/// the ratio farthest from 1 of all rows of the table.
struct TailRatios {
  double e4 = 1, e5 = 1, e6 = 1;
};

/// The errors of one of the two slopes.
struct TableErrors {
  double max_u_error = 0;
  /// Mean over rows and u, both uniform in the table's row coordinate and in u.
  double mean_u_error = 0;
  /// Where the maximum is, at unit roughness: theta in degrees, or the slope x.
  double worst_row = 0;
  double worst_u = 0;
  double max_density_error = 0;  ///< |sampled / exact density - 1|, for u in [1e-6, 1 - 1e-6]
  TailRatios lower, upper;
};

/// The smallest projected area of the facets that face a direction, per area of a surface of unit
/// mean slope, at which errors are measured.
inline constexpr double kLeastArea = 1e-12;

struct Certificate {
  /// Of the marginal for directions above the horizon, and of the conditional.
  TableErrors marginal, conditional;
  /// Of the marginal for directions below the horizon that see at least kLeastArea of the surface;
  /// zeros where tables have nothing for these. Where the visible slopes differ by little, as at
  /// the rim of a bounded distribution, rounding to single precision is most of it.
  TableErrors below;
  double max_d_error = 0;  ///< relative, over slopes to the radius that 1e-12 of them exceed
  /// Of the visible area, relative, over directions that see at least kLeastArea: above the horizon
  /// that is the error of 1 + Lambda and of G1, and below it that of Lambda.
  double max_lambda_error = 0;
  double max_pdf_error = 0;  ///< relative, over sampled normals of the same directions
};

/// Calls `visit(name, value)` for each figure of `errors`, in the order in which they are printed.
template <class Errors, class Visit>
void for_each_table_figure(Errors& errors, const std::string& table, Visit visit) {
  visit(table + "_max_u_error", errors.max_u_error);
  visit(table + "_mean_u_error", errors.mean_u_error);
  visit(table + "_worst_row", errors.worst_row);
  visit(table + "_worst_u", errors.worst_u);
  visit(table + "_max_density_error", errors.max_density_error);
  visit(table + "_lower_tail_ratio_1e-4", errors.lower.e4);
  visit(table + "_lower_tail_ratio_1e-5", errors.lower.e5);
  visit(table + "_lower_tail_ratio_1e-6", errors.lower.e6);
  visit(table + "_upper_tail_ratio_1e-4", errors.upper.e4);
  visit(table + "_upper_tail_ratio_1e-5", errors.upper.e5);
  visit(table + "_upper_tail_ratio_1e-6", errors.upper.e6);
}

/// Calls `visit(name, value)` for each figure of `certificate` (const or not): the one list of
/// names that files, reports and tests share.
template <class C, class Visit>
void for_each_figure(C& certificate, Visit visit) {
  for_each_table_figure(certificate.marginal, "marginal", visit);
  for_each_table_figure(certificate.conditional, "conditional", visit);
  for_each_table_figure(certificate.below, "below", visit);
  visit(std::string("max_d_error"), certificate.max_d_error);
  visit(std::string("max_lambda_error"), certificate.max_lambda_error);
  visit(std::string("max_pdf_error"), certificate.max_pdf_error);
}

}  // namespace vndf
