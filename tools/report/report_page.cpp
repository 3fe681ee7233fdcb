// The page of a report of validation.
#include "report/report_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/html.h"
#include "report/verdict_text.h"

namespace vndf::tools {
namespace {

using validate::CheckResult;
using validate::Kind;

/// On a screen too narrow for the columns of a table, every row becomes a block of lines: the cells
/// would otherwise be squeezed to a word a line.
constexpr const char* kStyle = R"(
td.place { color: #666; }
.pass { color: #1a7f37; font-weight: bold; }
.fail { color: #c1121f; font-weight: bold; }
tr.failed { background: #fdecec; }
@media (max-width: 720px) {
  table, tbody { display: block; }
  tr { display: grid; grid-template-columns: 3em 7em 1fr; column-gap: 0.5em; padding: 4px 0; border-bottom: 1px solid #ddd; }
  tr.heads { display: none; }
  td { border: 0; padding: 0; overflow-wrap: anywhere; }
  td.number { text-align: left; }
  td.measured { grid-column: 2; }
  td.place, td.wide { grid-column: 2 / -1; }
}
)";

std::string mark(bool passed) {
  return passed ? "<span class=\"pass\">pass</span>" : "<span class=\"fail\">FAIL</span>";
}

std::string row(const CheckResult& r) {
  return fmt::format(
      "<tr{}><td>{}</td><td>{}</td><td>{}</td><td class=\"number measured\">{:.3g}</td><td "
      "class=\"number\">{} {:.3g}</td><td class=\"place\">{}</td></tr>\n",
      r.passed() ? "" : " class=\"failed\"", mark(r.passed()), escaped(r.check),
      escaped(r.statistic), r.measured, r.kind == Kind::error ? "≤" : "p ≥", r.bound,
      escaped(remark(r)));
}

std::string row(const validate::SkippedCheck& s) {
  return fmt::format(
      "<tr><td></td><td>{}</td><td>{}</td><td></td><td></td><td>not run: {}</td></tr>\n",
      escaped(s.check), escaped(s.statistic), escaped(s.reason));
}

std::string results(const validate::Verdict& verdict) {
  std::string text =
      "<table><tr class=\"heads\"><th></th><th>check</th><th>statistic</th><th class=\"number\">"
      "measured</th><th class=\"number\">bound</th><th>where it is worst</th></tr>\n";
  for (const CheckResult& r : verdict.results) text += row(r);
  for (const auto& skipped : verdict.skipped) text += row(skipped);
  return text + "</table>\n";
}

std::string figure(const ReportSection& section, const Picture& picture) {
  std::string text = fmt::format("<h3>{}</h3>\n<figure>\n", escaped(picture.title));
  std::string data;
  if (!picture.png.empty()) {
    const std::string file = data_file(section, picture);
    text += fmt::format("<img alt=\"{}\" src=\"{}\">\n", escaped(picture.title),
                        png_address(picture.png));
    data = fmt::format(" Data: <a href=\"{0}\"><code>{0}</code></a>.", file);
  }
  return text +
         fmt::format("<figcaption>{}{}</figcaption>\n</figure>\n", escaped(picture.caption), data);
}

std::string section_text(const ReportSection& s, std::size_t number) {
  const auto& v = s.verdict;
  std::string text = fmt::format("<h2 id=\"s{}\">{}: {}</h2>\n<p>Slopes: <code>{}</code>", number,
                                 escaped(s.sampler), mark(v.passed()), escaped(s.distribution));
  for (const auto& resolution : v.resolutions) text += ". " + resolution_text(resolution);
  text += ".</p>\n" + results(v);
  for (const Picture& p : s.pictures) text += figure(s, p);
  return text;
}

std::string overview(const std::vector<ReportSection>& sections) {
  std::string text =
      "<table><tr class=\"heads\"><th></th><th>sampler</th><th>slopes</th><th>what "
      "fails</th></tr>\n";
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const ReportSection& s = sections[k];
    std::string failures;
    for (const CheckResult& r : s.verdict.results)
      if (!r.passed()) failures += (failures.empty() ? "" : "; ") + r.check + ": " + r.statistic;
    text += fmt::format(
        "<tr><td>{}</td><td class=\"wide\"><a href=\"#s{}\">{}</a></td><td class=\"wide\"><code>{}"
        "</code></td><td class=\"wide\">{}</td></tr>\n",
        mark(s.verdict.passed()), k, escaped(s.sampler), escaped(s.distribution),
        escaped(failures));
  }
  return text + "</table>\n";
}

}  // namespace

std::string data_file(const ReportSection& section, const Picture& picture) {
  return section.stem + "-" + picture.name + ".exr";
}

std::string report_page(const ReportedRun& run, const std::vector<ReportSection>& sections) {
  const auto failed = std::count_if(sections.begin(), sections.end(),
                                    [](const auto& s) { return !s.verdict.passed(); });
  const std::string title =
      fmt::format("Samplers of visible normals: {} checked, {} failed", sections.size(), failed);
  std::string body = fmt::format(
      "<p>Made by {}, <code>vndf validate{}</code>, seed {}. An error passes if it is not larger "
      "than its bound. A probability p is that of counts at least as uneven as those seen, were "
      "the sampler exact; it passes if it is not smaller than its bound.</p>\n",
      run.program, escaped(run.effort), run.seed);
  body += overview(sections);
  for (std::size_t k = 0; k < sections.size(); ++k) body += section_text(sections[k], k);
  return html_text({title, kStyle, body});
}

}  // namespace vndf::tools
