// What the pages that the program writes have in common. A page is one HTML text that needs no
// other file, so that it can be sent to somebody; its style and its pictures are inside.
#pragma once

#include <string>

namespace vndf::tools {

/// `text` with the characters replaced that have a meaning in HTML, quotes among them.
std::string escaped(const std::string& text);

/// The address of an image that is `png`, the bytes of a PNG file, for the attribute src.
std::string png_address(const std::string& png);

struct HtmlPage {
  std::string title;  ///< plain text; the page's heading, too
  std::string style;  ///< CSS that is added to the style that all pages share
  std::string body;   ///< HTML below the heading
};

/// The whole text of a page, which is readable on a narrow screen too.
std::string html_text(const HtmlPage& page);

}  // namespace vndf::tools
