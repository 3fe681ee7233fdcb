// How the program shows a verdict.
#include "report/verdict_text.h"

#include <fmt/format.h>

#include <cmath>

namespace vndf::tools {
namespace {

using validate::CheckResult;
using validate::Kind;
using validate::Place;
using validate::Verdict;

/// "theta 60, alpha 2 x 1, u1 0.5, u2 0.25", with what applies.
std::string text_of(const Place& p) {
  std::string text;
  if (!std::isnan(p.theta))
    text = fmt::format("theta {:.6g}, alpha {:.4g} x {:.4g}", p.theta, p.alpha_x, p.alpha_y);
  if (!std::isnan(p.u1)) text += fmt::format(", u1 {:.7g}", p.u1);
  if (!std::isnan(p.u2)) text += fmt::format(", u2 {:.7g}", p.u2);
  return text;
}

std::string row(const CheckResult& f) {
  const char* sign = f.kind == Kind::error ? "<=" : "p >=";
  return fmt::format("  {:<4}  {:<14}{:<31}{:>10.3g}  {:>4} {:<10.3g} {}\n",
                     f.passed() ? "pass" : "FAIL", f.check, f.statistic, f.measured, sign, f.bound,
                     remark(f));
}

nlohmann::ordered_json to_json(const CheckResult& f) {
  nlohmann::ordered_json json{{"check", f.check},
                              {"statistic", f.statistic},
                              {"kind", f.kind == Kind::error ? "error" : "p-value"},
                              {"measured", f.measured},
                              {"bound", f.bound},
                              {"passed", f.passed()}};
  const auto add = [&](const char* name, double value) {
    if (!std::isnan(value)) json[name] = value;
  };
  add("theta", f.where.theta);
  add("alpha_x", f.where.alpha_x);
  add("alpha_y", f.where.alpha_y);
  add("u1", f.where.u1);
  add("u2", f.where.u2);
  if (f.tests > 0) json["tests"] = f.tests;
  if (!f.note.empty()) json["note"] = f.note;
  return json;
}

}  // namespace

std::string remark(const CheckResult& f) {
  std::string text = text_of(f.where);
  if (!f.note.empty()) text += (text.empty() ? "" : "; ") + f.note;
  return text;
}

std::string describe(const Verdict& verdict) {
  std::string text = fmt::format("{}: {}\n", verdict.sampler, verdict.passed() ? "pass" : "FAIL");
  for (const CheckResult& f : verdict.results) text += row(f);
  if (verdict.samples > 0)
    text += fmt::format(
        "  {} samples counted; those of one configuration show errors of {:.1e} in u and of "
        "{:.1e} in the mass of a bin\n",
        verdict.samples, verdict.visible_u_error, verdict.visible_bin_error);
  return text;
}

nlohmann::ordered_json to_json(const Verdict& verdict) {
  auto results = nlohmann::ordered_json::array();
  for (const CheckResult& f : verdict.results) results.push_back(to_json(f));
  return {{"sampler", verdict.sampler},
          {"passed", verdict.passed()},
          {"samples", verdict.samples},
          {"visible_u_error", verdict.visible_u_error},
          {"visible_bin_error", verdict.visible_bin_error},
          {"results", results}};
}

}  // namespace vndf::tools
