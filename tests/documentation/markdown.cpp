// Reads a page line by line. A block opens with a fence, or with an indented line after an empty
// one.
#include "documentation/markdown.h"

#include <cctype>
#include <regex>
#include <sstream>

namespace vndf::documentation {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The text of an HTML comment that is a line of its own, or an empty string.
std::string comment_in(const std::string& line) {
  std::smatch match;
  static const std::regex kComment("^<!-- (.*) -->$");
  return std::regex_match(line, match, kComment) ? match[1].str() : "";
}

/// Lower case, without punctuation, with hyphens for spaces.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) || c == '-' || c == '_' || letter >= 128)
      anchor += static_cast<char>(std::tolower(letter));
    else if (c == ' ')
      anchor += '-';
  }
  return anchor;
}

void add_links(const std::string& line, int number, Page& page) {
  static const std::regex kLink("\\]\\(([^) ]+)\\)");
  for (std::sregex_iterator i(line.begin(), line.end(), kLink), end; i != end; ++i)
    page.links.push_back({(*i)[1], number});
}

bool indented(const std::string& line) {
  return line.starts_with("    ") && line.find_first_not_of(' ') != std::string::npos;
}

}  // namespace

Page read_page(const std::string& text) {
  const auto lines = lines_of(text);
  Page page;
  page.lines = static_cast<int>(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    const std::string before = i > 0 ? lines[i - 1] : "";
    if (lines[i].starts_with("```")) {
      CodeBlock block{lines[i].substr(3), comment_in(before), "", number, true};
      while (++i < lines.size() && lines[i] != "```") block.text += lines[i] + '\n';
      page.blocks.push_back(block);
    } else if (indented(lines[i]) && before.empty()) {
      CodeBlock block{"", "", lines[i] + '\n', number, false};
      while (i + 1 < lines.size() && indented(lines[i + 1])) block.text += lines[++i] + '\n';
      page.blocks.push_back(block);
    } else {
      add_links(lines[i], number, page);
      const auto marks = lines[i].find_first_not_of('#');
      if (marks != std::string::npos && marks > 0 && lines[i][marks] == ' ')
        page.anchors.push_back(anchor_of(lines[i].substr(marks + 1)));
    }
  }
  return page;
}

std::vector<Command> commands_of(const CodeBlock& block) {
  const bool console = block.language == "console";
  std::vector<Command> commands;
  bool continued = false;
  int number = block.line;
  for (const std::string& line : lines_of(block.text)) {
    ++number;
    const bool opens = console ? line.starts_with("$ ") : !line.empty() && line[0] != '#';
    if (continued)
      commands.back().text += line + '\n';
    else if (opens)
      commands.push_back({(console ? line.substr(2) : line) + '\n', "", number});
    else if (console && !commands.empty())
      commands.back().output += line + '\n';
    continued = (continued || opens) && line.ends_with('\\');
  }
  return commands;
}

}  // namespace vndf::documentation
