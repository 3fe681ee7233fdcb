// What the pages that the program writes have in common.
#include "report/html.h"

#include <fmt/format.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>

namespace vndf::tools {
namespace {

/// Names that cannot be broken may be broken anywhere, so that no page is wider than its screen.
constexpr const char* kStyle = R"(
body { font: 15px/1.5 sans-serif; color: #222; background: #fff; max-width: 1120px; margin: clamp(1em, 3vw, 2em) auto; padding: 0 1em; }
h1 { font-size: 1.6em; margin-bottom: 0.2em; }
h2 { font-size: 1.35em; margin-top: 2.5em; border-top: 2px solid #222; padding-top: 0.6em; }
h3 { font-size: 1.05em; margin: 1.8em 0 0.3em; }
h1, h2, p { overflow-wrap: anywhere; }
table { border-collapse: collapse; font-size: 13px; width: 100%; }
th, td { text-align: left; padding: 2px 10px 2px 0; border-bottom: 1px solid #ddd; vertical-align: top; }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
figure { margin: 0; }
img { width: 100%; height: auto; display: block; }
figcaption { font-size: 13px; color: #444; max-width: 62em; }
code { font-size: 0.95em; }
)";

std::string base64(std::string bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<std::string::const_iterator, 6, 8>>;
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  bytes.append(missing, '\0');  // the digits are made of whole groups of three
  std::string text(Digits(bytes.cbegin()), Digits(bytes.cend()));
  return text.replace(text.size() - missing, missing, missing, '=');
}

}  // namespace

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

std::string png_address(const std::string& png) {
  return "data:image/png;base64," + base64(png);
}

std::string html_text(const HtmlPage& page) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}{2}</style>\n</head>\n<body>\n"
      "<h1>{0}</h1>\n{3}</body>\n</html>\n",
      escaped(page.title), kStyle, page.style, page.body);
}

}  // namespace vndf::tools
