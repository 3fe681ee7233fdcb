// All commands of a page run in one shell, in the order of the page, so that later ones use what
// earlier ones wrote.
#include "documentation/check_page.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>

#include "documentation/expected_output.h"
#include "documentation/markdown.h"

namespace vndf::documentation {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string at(int line, const std::string& what) {
  return "line " + std::to_string(line) + ": " + what;
}

/// The rest of a mark after `key`, such as "20 %" of "within 20 %"; empty where it has no such key.
std::string mark_after(const std::string& mark, const std::string& key) {
  std::smatch match;
  const bool found = std::regex_search(mark, match, std::regex("(^|, )" + key + " ([^,]+)"));
  return found ? match[2].str() : "";
}

bool has_reason(const CodeBlock& block) {
  return block.mark.starts_with("not run: ");
}

bool is_shell(const CodeBlock& block) {
  return (block.language == "console" || block.language == "sh") && !has_reason(block);
}

class Checker {
 public:
  Checker(const Page& page, fs::path folder, const Surroundings& surroundings)
      : page_(page), folder_(std::move(folder)), s_(surroundings) {}

  std::vector<std::string> problems() {
    for (const Link& link : page_.links) check_link(link);
    for (const CodeBlock& block : page_.blocks) check_block(block);
    run_commands();
    return problems_;
  }

 private:
  void check_link(const Link& link) {
    if (link.target.find("://") != std::string::npos) return;
    const auto hash = link.target.find('#');
    const fs::path file = folder_ / link.target.substr(0, hash);
    if (!fs::exists(file))
      return complain(link.line, "a link to " + link.target + ", which is not there");
    if (hash == std::string::npos) return;
    const auto anchors = hash == 0 ? page_.anchors : read_page(content(file)).anchors;
    if (std::ranges::find(anchors, link.target.substr(hash + 1)) == anchors.end())
      complain(link.line, "a link to " + link.target + ", a heading that is not there");
  }

  void check_block(const CodeBlock& block) {
    if (!block.fenced)
      complain(block.line, "an indented code block; fence it, with its language");
    else if (has_reason(block) || is_shell(block) || block.language == "math")
      return;
    else if (const auto file = mark_after(block.mark, "file"); !file.empty())
      std::ofstream(s_.scratch / file) << block.text;
    else if (const auto source = mark_after(block.mark, "from"); !source.empty())
      check_excerpt(block, source);
    else
      complain(block.line, "a code block that nothing checks; mark it");
  }

  /// The lines of the block are lines of the file, one after the other.
  void check_excerpt(const CodeBlock& block, const std::string& source) {
    const std::string text = '\n' + content(s_.source / source);
    if (text.find('\n' + block.text) == std::string::npos)
      complain(block.line, "not the lines of " + source);
  }

  void run_commands() {
    std::vector<Command> commands;
    std::vector<const CodeBlock*> blocks;
    for (const CodeBlock& block : page_.blocks) {
      if (!is_shell(block)) continue;
      for (const Command& command : commands_of(block)) {
        commands.push_back(command);
        blocks.push_back(&block);
      }
    }
    const fs::path streams = s_.scratch.string() + "-streams";
    fs::remove_all(streams);
    fs::create_directories(streams);
    write_script(commands, streams);
    const std::string shell = "sh '" + (streams / "script").string() + "' </dev/null";
    [[maybe_unused]] const int status = std::system(shell.c_str());  // each command has its own
    for (std::size_t i = 0; i < commands.size(); ++i)
      check_command(commands[i], *blocks[i], i + 1 == commands.size() || blocks[i + 1] != blocks[i],
                    streams / std::to_string(i));
  }

  void write_script(const std::vector<Command>& commands, const fs::path& streams) const {
    std::ofstream script(streams / "script");
    script << "export LC_ALL=C PATH='" << s_.program.parent_path().string() << "':\"$PATH\"\n"
           << "cd '" << s_.scratch.string() << "'\n";
    for (std::size_t i = 0; i < commands.size(); ++i) {
      const std::string base = (streams / std::to_string(i)).string();
      std::ofstream(base + ".sh") << commands[i].text;
      script << ". '" << base << ".sh' >'" << base << ".out' 2>&1\necho $? >'" << base
             << ".status'\n";
    }
  }

  void check_command(const Command& command, const CodeBlock& block, bool last,
                     const fs::path& base) {
    const std::string name = command.text.substr(0, command.text.find('\n'));
    const std::string printed = content(base.string() + ".out");
    const auto stated = last ? mark_after(block.mark, "status") : "";
    const std::string status = content(base.string() + ".status");
    if (status != (stated.empty() ? "0" : stated) + "\n")
      return complain(command.line, name + " has status " + status + " and prints\n" + printed);
    if (block.language == "sh") return;
    const auto percent = mark_after(block.mark, "within");
    const double tolerance = percent.empty() ? kNumberTolerance : std::stod(percent) / 100;
    const std::string difference = first_difference(command.output, printed, tolerance);
    if (!difference.empty())
      complain(command.line, name + " does not print\n" + difference + "\nbut\n" + printed);
  }

  void complain(int line, const std::string& what) { problems_.push_back(at(line, what)); }

  const Page& page_;
  fs::path folder_;
  const Surroundings& s_;
  std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> problems_of(const std::string& text, const fs::path& folder,
                                     const Surroundings& surroundings) {
  const Page page = read_page(text);
  return Checker(page, folder, surroundings).problems();
}

}  // namespace vndf::documentation
