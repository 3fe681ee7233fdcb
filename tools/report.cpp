// How the program shows a table file and its certificate.
#include "report.h"

#include <fmt/format.h>

#include <sstream>

namespace vndf::tools {
namespace {

void line(std::string& text, std::string_view what, const std::string& value) {
  text += fmt::format("  {:<24}{}\n", what, value);
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
  text += fmt::format("{} table\n", name);
  line(text, "u-error, max",
       fmt::format("{:.2e}   at {} {:.4g}, u {:.6g}", e.max_u_error, row, e.worst_row, e.worst_u));
  line(text, "u-error, mean", fmt::format("{:.2e}", e.mean_u_error));
  line(text, "density error, max", fmt::format("{:.2e}", e.max_density_error));
  line(text, "tail mass ratio, low", ratios(e.lower));
  line(text, "tail mass ratio, high", ratios(e.upper) + "   at 1e-4, 1e-5, 1e-6");
}

}  // namespace

std::string describe(const io::TableFile& file) {
  const SlopeTables& t = *file.tables;
  std::string text = fmt::format("{} slopes\n", t.distribution);
  line(text, "made by", file.provenance.recipe);
  line(text, "with", file.provenance.program);
  if (!file.provenance.input_checksum.empty())
    line(text, "from a file of", "CRC-64 " + file.provenance.input_checksum);
  std::istringstream notes(file.provenance.notes);
  for (std::string note; std::getline(notes, note);) line(text, "", note);
  line(text, "mean slope E|X|", fmt::format("{:.10g}", t.mean_slope));
  line(text, "marginal table", size_of(t.marginal, "(theta, u1)"));
  line(text, "conditional table",
       size_of(t.conditional, "(|x|, u2)") +
           (conditional_factorises(t) ? ", the same for all x" : ""));
  line(text, "sampling reads",
       fmt::format("{:.1f} KiB", static_cast<double>(sampling_bytes(t)) / 1024));
  text += fmt::format("\nCertificate: errors in {} precision, measured off the grid\n",
                      t.marginal.in_double() ? "double" : "single");
  const Certificate& c = file.certificate;
  describe(text, c.marginal, "marginal", "theta (degrees)");
  describe(text, c.conditional, "conditional", "slope x");
  text += "functions, relative error, max\n";
  line(text, "D", fmt::format("{:.2e}", c.max_d_error));
  line(text, "Lambda (of 1 + Lambda)", fmt::format("{:.2e}", c.max_lambda_error));
  line(text, "pdf", fmt::format("{:.2e}", c.max_pdf_error));
  return text;
}

nlohmann::ordered_json to_json(const io::TableFile& file) {
  const SlopeTables& t = *file.tables;
  nlohmann::ordered_json certificate;
  for_each_figure(file.certificate,
                  [&](const std::string& name, double v) { certificate[name] = v; });
  return {{"distribution", t.distribution},
          {"recipe", file.provenance.recipe},
          {"program", file.provenance.program},
          {"input_checksum", file.provenance.input_checksum},
          {"notes", file.provenance.notes},
          {"mean_slope", t.mean_slope},
          {"marginal_size", {t.marginal.rows(), t.marginal.columns()}},
          {"conditional_size", {t.conditional.rows(), t.conditional.columns()}},
          {"sampling_bytes", sampling_bytes(t)},
          {"certificate", certificate}};
}

}  // namespace vndf::tools
