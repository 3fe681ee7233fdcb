// How the program shows a verdict.
#include "report/verdict_text.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "vndf/support/text.h"
#include "vndf/validate/exact/place_text.h"

namespace vndf::tools {
namespace {

using validate::CheckResult;
using validate::Kind;
using validate::Place;
using validate::Resolution;
using validate::SkippedCheck;
using validate::Verdict;

/// "theta 60, alpha 2 x 1, u1 0.5, u2 0.25", with what applies.
std::string text_of(const Place& p) {
  std::string text;
  if (!std::isnan(p.theta))
    text = fmt::format("theta {:.6g}, alpha {:.4g} x {:.4g}{}", p.theta, p.alpha_x, p.alpha_y,
                       validate::surface_text(p));
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

/// Rows of what was not run. Statistics that are missing for the same reason share one.
std::string skipped_rows(const std::vector<SkippedCheck>& skipped) {
  std::string text;
  for (std::size_t first = 0, end = 0; first < skipped.size(); first = end) {
    const SkippedCheck& s = skipped[first];
    std::vector<std::string> statistics;
    for (; end < skipped.size() && skipped[end].check == s.check && skipped[end].reason == s.reason;
         ++end)
      statistics.push_back(skipped[end].statistic.empty() ? "all" : skipped[end].statistic);
    text += fmt::format("  {:<4}  {:<14}{:<31} not run: {}\n", "-", s.check,
                        support::listed(statistics), s.reason);
  }
  return text;
}

nlohmann::ordered_json to_json(const Resolution& r) {
  return {{"counted", r.counted},
          {"samples", r.samples},
          {"u_error", r.u_error},
          {"bin_error", r.bin_error}};
}

/// Adds what is known of the place, and the surface where it is not flat.
void add_place(nlohmann::ordered_json& json, const Place& p) {
  const auto add = [&](const char* name, double value) {
    if (!std::isnan(value)) json[name] = value;
  };
  add("theta", p.theta);
  add("alpha_x", p.alpha_x);
  add("alpha_y", p.alpha_y);
  for (const auto& [name, value] :
       {std::pair{"correlation", p.correlation}, {"mean_x", p.mean_x}, {"mean_y", p.mean_y}})
    if (value != 0) json[name] = value;
  add("u1", p.u1);
  add("u2", p.u2);
}

nlohmann::ordered_json to_json(const SkippedCheck& s) {
  nlohmann::ordered_json json{{"check", s.check}};
  if (!s.statistic.empty()) json["statistic"] = s.statistic;
  json["reason"] = s.reason;
  if (s.where.empty()) return json;
  auto places = nlohmann::ordered_json::array();
  for (const Place& p : s.where) {
    nlohmann::ordered_json place;
    add_place(place, p);
    places.push_back(std::move(place));
  }
  json["configurations"] = places;
  return json;
}

nlohmann::ordered_json to_json(const CheckResult& f) {
  nlohmann::ordered_json json{{"check", f.check},
                              {"statistic", f.statistic},
                              {"kind", f.kind == Kind::error ? "error" : "p-value"},
                              {"measured", f.measured},
                              {"bound", f.bound},
                              {"passed", f.passed()}};
  add_place(json, f.where);
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
  std::string text = fmt::format("{}: {}\n", support::printable(verdict.sampler),
                                 verdict.passed() ? "pass" : "FAIL");
  for (const CheckResult& f : verdict.results) text += row(f);
  text += skipped_rows(verdict.skipped);
  for (const Resolution& r : verdict.resolutions) text += fmt::format("  {}\n", resolution_text(r));
  return text;
}

std::string conclusion(const Verdict& verdict) {
  const auto failures = verdict.failures();
  if (failures.empty()) return "accepted\n";
  const CheckResult& worst = failures.front();
  std::string text = fmt::format("rejected: {}, {}", worst.check, worst.statistic);
  if (!std::isnan(worst.where.theta))
    text +=
        fmt::format(" at theta {:.6g} degrees, alpha {:.4g} x {:.4g}{}", worst.where.theta,
                    worst.where.alpha_x, worst.where.alpha_y, validate::surface_text(worst.where));
  for (std::size_t k = 1; k < failures.size(); ++k)
    text += fmt::format("; {}, {}", failures[k].check, failures[k].statistic);
  return text + "\n";
}

std::string resolution_text(const Resolution& r) {
  return fmt::format(
      "{} samples of {} were counted, which show errors of {:.1e} in u and of {:.1e} in the mass "
      "of a bin",
      r.samples, r.counted, r.u_error, r.bin_error);
}

nlohmann::ordered_json to_json(const Verdict& verdict) {
  auto results = nlohmann::ordered_json::array(), skipped = results, resolutions = results;
  for (const CheckResult& f : verdict.results) results.push_back(to_json(f));
  for (const SkippedCheck& s : verdict.skipped) skipped.push_back(to_json(s));
  for (const Resolution& r : verdict.resolutions) resolutions.push_back(to_json(r));
  return {{"sampler", verdict.sampler}, {"passed", verdict.passed()}, {"samples", verdict.samples},
          {"resolutions", resolutions}, {"results", results},         {"not_run", skipped}};
}

}  // namespace vndf::tools
