// The parts of a Markdown page that can go wrong: code blocks, links and headings.
//
// The HTML comment in the line before a code block is its mark. It tells the test what to do with
// the block, and a reader of the page does not see it. tests/README.md lists the marks.
#pragma once

#include <string>
#include <vector>

namespace vndf::documentation {

struct CodeBlock {
  std::string language;  // the word after the fence; empty for an indented block
  std::string mark;      // the text of the comment before it; empty without one
  std::string text;      // with a line end after each line
  int line = 0;          // of its fence, counted from 1
  bool fenced = true;
};

struct Link {
  std::string target;
  int line = 0;
};

struct Page {
  std::vector<CodeBlock> blocks;
  std::vector<Link> links;
  std::vector<std::string> anchors;  // what a link to a heading names, as GitHub makes it
  int lines = 0;
};

Page read_page(const std::string& text);

/// A command of a block of shell commands, and what the page says that it prints.
struct Command {
  std::string text;
  std::string output;  // empty where the block is of language "sh", which states none
  int line = 0;
};

/// The commands of a block. In "console" a command follows "$ " and what it prints follows it; in
/// "sh" each line is a command. A backslash at the end of a line continues the command in the next
/// line.
std::vector<Command> commands_of(const CodeBlock& block);

}  // namespace vndf::documentation
