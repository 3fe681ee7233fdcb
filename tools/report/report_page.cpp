// The page of a report of validation.
#include "report/report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

#include "report/verdict_text.h"

namespace vndf::tools {
namespace {

using validate::CheckResult;
using validate::Kind;

/// On a screen too narrow for the columns of a table, every row becomes a block of lines: the cells
/// would otherwise be squeezed to a word a line. Names that cannot be broken may be broken
/// anywhere.
constexpr const char* kStyle = R"(
body { font: 15px/1.5 sans-serif; color: #222; background: #fff; max-width: 1120px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; margin-bottom: 0.2em; }
h2 { font-size: 1.35em; margin-top: 2.5em; border-top: 2px solid #222; padding-top: 0.6em; }
h3 { font-size: 1.05em; margin: 1.8em 0 0.3em; }
h1, h2, p { overflow-wrap: anywhere; }
table { border-collapse: collapse; font-size: 13px; width: 100%; }
th, td { text-align: left; padding: 2px 10px 2px 0; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
td.place { color: #666; }
.pass { color: #1a7f37; font-weight: bold; }
.fail { color: #c1121f; font-weight: bold; }
tr.failed { background: #fdecec; }
figure { margin: 0; }
img { width: 100%; height: auto; display: block; }
figcaption { font-size: 13px; color: #444; max-width: 62em; }
code { font-size: 0.95em; }
@media (max-width: 720px) {
  body { margin: 1em auto; }
  table, tbody { display: block; }
  tr { display: grid; grid-template-columns: 3em 7em 1fr; column-gap: 0.5em; padding: 4px 0; border-bottom: 1px solid #ddd; }
  tr.heads { display: none; }
  td { border: 0; padding: 0; overflow-wrap: anywhere; }
  td.number { text-align: left; }
  td.measured { grid-column: 2; }
  td.place, td.wide { grid-column: 2 / -1; }
}
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string base64(std::string bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  bytes.append(missing, '\0');  // the digits are made of whole groups of three
  std::string text(Digits(bytes.cbegin()), Digits(bytes.cend()));
  return text.replace(text.size() - missing, missing, missing, '=');
}

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
    text += fmt::format("<img alt=\"{}\" src=\"data:image/png;base64,{}\">\n",
                        escaped(picture.title), base64(picture.png));
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
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n"
      "<h1>{0}</h1>\n<p>Made by {2}, <code>vndf validate{3}</code>, seed {4}. An error passes if "
      "it "
      "is not larger than its bound. A probability p is that of counts at least as uneven as those "
      "seen, were the sampler exact; it passes if it is not smaller than its bound.</p>\n",
      title, kStyle, escaped(run.program), escaped(run.effort), run.seed);
  text += overview(sections);
  for (std::size_t k = 0; k < sections.size(); ++k) text += section_text(sections[k], k);
  return text + "</body>\n</html>\n";
}

}  // namespace vndf::tools
