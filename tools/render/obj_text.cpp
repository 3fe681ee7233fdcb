// Reads OBJ line by line and word by word.
#include "render/obj_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

#include "vndf/io/format_error.h"
#include "vndf/support/text.h"

namespace vndf::render {
namespace {

/// What is before the next `end`, which is taken away with it.
std::string_view take_until(std::string_view& text, char end) {
  const std::size_t length = std::min(text.find(end), text.size());
  const std::string_view taken = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return taken;
}

/// The next word, or nothing at the end of the line.
std::string_view take_word(std::string_view& line) {
  constexpr std::string_view kBlanks = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
  line.remove_prefix(word.size());
  return word;
}

class Reader {
 public:
  ObjText read(std::string_view text) {
    while (!text.empty()) {
      ++line_number_;
      std::string_view line = take_until(text, '\n');
      read_line(take_until(line, '#'));
    }
    return std::move(obj_);
  }

 private:
  using Corner = ObjText::Corner;

  void read_line(std::string_view line) {
    const std::string_view keyword = take_word(line);
    if (keyword == "v") obj_.positions.push_back(read_vector(line, kLargestCoordinate));
    if (keyword == "vt") obj_.places.push_back(read_place(line));
    if (keyword == "vn") obj_.normals.push_back(read_normal(line));
    if (keyword == "f") read_face(line);
  }

  float read_number(std::string_view& line, double largest) const {
    const std::string_view word = take_word(line);
    if (word.empty()) fail("it has fewer numbers than it needs", "export the mesh again");
    const auto number = support::finite_number(word.starts_with('+') ? word.substr(1) : word);
    if (!number) fail(support::quoted(word) + " is not a finite number", "export the mesh again");
    if (std::abs(*number) > largest)
      fail(support::quoted(word) + " is more than " + support::rounded_text(largest),
           "scale the mesh down");
    return static_cast<float>(*number);
  }

  Vector read_vector(std::string_view& line, double largest) const {
    const float x = read_number(line, largest), y = read_number(line, largest);
    return {x, y, read_number(line, largest)};
  }

  Vector read_normal(std::string_view line) const {
    const Vector normal = read_vector(line, kLargestCoordinate);
    if (normal.x == 0 && normal.y == 0 && normal.z == 0)
      fail("the normal has no length", "export the mesh without normals");
    return normalize_or_up(normal);
  }

  Vec2<float> read_place(std::string_view line) const {
    const float u = read_number(line, kLargestCoordinate);
    std::string_view rest = line;
    return {u, take_word(rest).empty() ? 0 : read_number(line, kLargestCoordinate)};
  }

  void read_face(std::string_view line) {
    const std::size_t first = obj_.corners.size();
    for (auto word = take_word(line); !word.empty(); word = take_word(line))
      obj_.corners.push_back(read_corner(word));
    const std::size_t count = obj_.corners.size() - first;
    if (count < 3) fail("a face has three corners or more", "export the mesh again");
    obj_.faces.push_back({first, count, line_number_});
  }

  /// "1", "1/2", "1//3" or "1/2/3".
  Corner read_corner(std::string_view word) const {
    const std::array<std::size_t, 3> counts{obj_.positions.size(), obj_.places.size(),
                                            obj_.normals.size()};
    Corner corner{ObjText::kNone, ObjText::kNone, ObjText::kNone};
    std::string_view rest = word;
    for (std::size_t part = 0; part < 3; ++part) {
      const std::string_view digits = take_until(rest, '/');
      if (part == 0 || !digits.empty()) corner[part] = read_index(digits, counts[part]);
    }
    if (!rest.empty())
      fail(support::quoted(word) + " has more than three indices", "export the mesh again");
    return corner;
  }

  /// Indices count from 1, or back from the last, which is -1.
  std::uint32_t read_index(std::string_view digits, std::size_t count) const {
    std::int64_t index = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, index);
    if (error != std::errc() || stop != end)
      fail(support::quoted(digits) + " is not an index", "export the mesh again");
    const auto last = static_cast<std::int64_t>(count);
    if (index == 0 || index > last || index < -last)
      fail("the index " + std::to_string(index) + " is not one of the " + std::to_string(count) +
               " above it",
           "export the mesh again");
    return static_cast<std::uint32_t>(index > 0 ? index - 1 : last + index);
  }

  [[noreturn]] void fail(const std::string& rule, const std::string& remedy) const {
    throw io::FormatError("line " + std::to_string(line_number_) + ": " + rule, remedy);
  }

  ObjText obj_;
  std::size_t line_number_ = 0;
};

}  // namespace

ObjText parse_obj(std::string_view text) {
  return Reader().read(text);
}

}  // namespace vndf::render
