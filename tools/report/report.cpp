// How the program shows a table file and its certificate.
#include "report/report.h"

#include "vndf/support/text.h"

#include <fmt/format.h>

#include <sstream>

namespace vndf::tools {
namespace {

void line(std::string& text, std::string_view what, const std::string& value) {
  text += fmt::format("  {:<24}{}\n", what, support::printable(value));
}

std::string size_of(const QuantileTable& table, std::string_view axes) {
  return fmt::format("{} x {}   {}{}", table.rows(), table.columns(), axes,
                     table.in_double() ? ", double precision" : "");
}

std::string ratios(const TailRatios& r) {
  return fmt::format("{:.4f}   {:.4f}   {:.4f}", r.e4, r.e5, r.e6);
}

void describe(std::string& text, const TableErrors& e, std::string_view name,
              std::string_view row) {
  text += fmt::format("{}\n", name);
  line(text, "u-error, max",
       fmt::format("{:.2e}   at {} {:.4g}, u {:.6g}", e.max_u_error, row, e.worst_row, e.worst_u));
  line(text, "u-error, mean", fmt::format("{:.2e}", e.mean_u_error));
  line(text, "density error, max", fmt::format("{:.2e}", e.max_density_error));
  line(text, "tail mass ratio, low", ratios(e.lower));
  line(text, "tail mass ratio, high", ratios(e.upper) + "   at 1e-4, 1e-5, 1e-6");
}

/// Adds a line for each line of `value`.
void lines(std::string& text, std::string_view what, const std::string& value) {
  std::istringstream stream(value);
  for (std::string part; std::getline(stream, part); what = "") line(text, what, part);
}

std::string text_of(const Specification& s) {
  return s.r.empty() ? s.text : fmt::format("{}, {} samples", s.text, s.r.size());
}

std::string summary_of(const SurfaceSlopes& s) {
  return fmt::format("alpha {:.6g} x {:.6g}, correlation {:.4g}, mean slope ({:.6g}, {:.6g})",
                     s.alpha.x, s.alpha.y, s.correlation, s.mean.x, s.mean.y);
}

nlohmann::ordered_json to_json(const SurfaceSlopes& s) {
  return {{"alpha", {s.alpha.x, s.alpha.y}},
          {"correlation", s.correlation},
          {"mean", {s.mean.x, s.mean.y}}};
}

/// The slopes and where they come from.
std::string heading(const std::string& distribution, const Provenance& origin) {
  std::string text = fmt::format("{} slopes\n", support::printable(distribution));
  line(text, "specification", text_of(origin.specification));
  lines(text, "made by", origin.command);
  line(text, "with", origin.program);
  lines(text, "notes", origin.notes);
  if (origin.surface) line(text, "surface of the map", summary_of(*origin.surface));
  return text;
}

nlohmann::ordered_json to_json(const std::string& distribution, const Provenance& origin) {
  nlohmann::ordered_json json{{"distribution", distribution},
                              {"specification", origin.specification.text},
                              {"samples", origin.specification.r.size()},
                              {"command", origin.command},
                              {"program", origin.program},
                              {"notes", origin.notes}};
  if (origin.surface) json["surface"] = to_json(*origin.surface);
  return json;
}

void describe(std::string& text, const Certificate& c) {
  describe(text, c.marginal, "marginal table", "theta (degrees)");
  if (c.below.max_u_error > 0)
    describe(text, c.below, "marginal table, below the horizon", "theta (degrees)");
  describe(text, c.conditional, "conditional table", "slope x");
  text += "functions, relative error, max\n";
  line(text, "D", fmt::format("{:.2e}", c.max_d_error));
  line(text, "Lambda (visible area)", fmt::format("{:.2e}", c.max_lambda_error));
  line(text, "pdf", fmt::format("{:.2e}", c.max_pdf_error));
}

nlohmann::ordered_json to_json(const Certificate& certificate) {
  nlohmann::ordered_json json;
  for_each_figure(certificate, [&](const std::string& name, double v) { json[name] = v; });
  return json;
}

std::string kibibytes(std::size_t bytes) {
  return fmt::format("{:.1f} KiB", static_cast<double>(bytes) / 1024);
}

const char* columns_of(const KernelHeader& h) {
  return h.column_roots != 0 ? "roots of probabilities" : "probabilities";
}

const char* conditional_of(const KernelHeader& h) {
  return h.separable != 0 ? "one row, over a scale that depends on x" : "rows in |x|";
}

}  // namespace

std::string describe(const io::TableFile& file) {
  const SlopeTables& t = *file.tables;
  std::string text = heading(t.distribution, file.provenance);
  line(text, "mean slope E|X|", fmt::format("{:.10g}", t.mean_slope));
  line(text, "marginal table", size_of(t.marginal, "(theta, u1)"));
  line(text, "conditional table",
       size_of(t.conditional, "(|x|, u2)") +
           (conditional_factorises(t) ? ", the same for all x" : ""));
  line(text, "sampling reads", kibibytes(sampling_bytes(t)));
  text += fmt::format("\nCertificate: errors in {} precision, measured off the grid\n",
                      t.marginal.in_double() ? "double" : "single");
  describe(text, file.certificate);
  return text;
}

std::string describe(const KernelTables& tables) {
  const KernelHeader& h = tables.header();
  const KernelText origin = tables.text();
  std::string text = heading(origin.distribution, origin.provenance);
  line(text, "baked within", fmt::format("{:g} of the pair, in u", h.tolerance));
  line(text, "differs from it by",
       fmt::format("{:.2e} in slope x, {:.2e} in slope y", h.difference_x, h.difference_y));
  line(text, "columns by", columns_of(h));
  line(text, "slope y", conditional_of(h));
  line(text, "unit of slopes", fmt::format("{:.7g}", h.unit));
  line(text, "sampling reads", kibibytes(tables.sampling_bytes()));
  line(text, "and below the horizon", h.below_bytes != 0 ? kibibytes(h.below_bytes) : "nothing");
  text +=
      h.certified != 0
          ? "\nCertificate: errors in single precision, measured against the exact distribution\n"
          : "\nCertificate: errors that follow from those of the pair, not measured\n";
  describe(text, tables.certificate());
  return text;
}

nlohmann::ordered_json to_json(const io::TableFile& file) {
  const SlopeTables& t = *file.tables;
  auto json = to_json(t.distribution, file.provenance);
  json["mean_slope"] = t.mean_slope;
  json["marginal_size"] = {t.marginal.rows(), t.marginal.columns()};
  json["conditional_size"] = {t.conditional.rows(), t.conditional.columns()};
  json["sampling_bytes"] = sampling_bytes(t);
  json["certificate"] = to_json(file.certificate);
  return json;
}

nlohmann::ordered_json to_json(const KernelTables& tables) {
  const KernelHeader& h = tables.header();
  const KernelText text = tables.text();
  auto json = to_json(text.distribution, text.provenance);
  json["tolerance"] = h.tolerance;
  json["difference_x"] = h.difference_x;
  json["difference_y"] = h.difference_y;
  json["columns"] = h.column_roots != 0 ? "roots" : "probabilities";
  json["separable"] = h.separable != 0;
  json["unit"] = h.unit;
  json["sampling_bytes"] = tables.sampling_bytes();
  json["below_bytes"] = h.below_bytes;
  json["bytes"] = tables.bytes().size();
  json["certified"] = h.certified != 0;
  json["certificate"] = to_json(tables.certificate());
  return json;
}

std::string written(const std::string& path, std::uintmax_t bytes, double seconds) {
  constexpr double kKibi = 1024, kMebi = kKibi * kKibi;
  const auto count = static_cast<double>(bytes);
  const std::string size = count < kMebi ? fmt::format("{:.1f} KiB", count / kKibi)
                                         : fmt::format("{:.1f} MiB", count / kMebi);
  return fmt::format("\nwrote {} ({}) in {:.2f} s\n", support::printable(path), size, seconds);
}

}  // namespace vndf::tools
