// Writing and reading the one line of a specification, and making the distribution of it.
#include "vndf/distributions/specification.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "vndf/distributions/diagnose.h"
#include "vndf/distributions/formula_distribution.h"
#include "vndf/distributions/mixture.h"
#include "vndf/distributions/parse_distribution.h"
#include "vndf/distributions/shape_invariance.h"
#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

constexpr std::string_view kP22 = "p22", kNdf = "ndf", kProfile = "profile", kNameItem = " name:";

struct NamedTail {
  std::string_view name;
  ProfileTail kind;
};
constexpr std::array<NamedTail, 3> kTails{{{"none", ProfileTail::none},
                                           {"exponential", ProfileTail::exponential},
                                           {"power", ProfileTail::power}}};

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

// Writing.

std::string quoted(const std::string& text) {
  if (std::any_of(text.begin(), text.end(), is_control))
    throw std::invalid_argument("the text " + support::quoted(text) +
                                " has a control character; a specification is one line, so leave "
                                "out line ends and tabs");
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

void check_name(const std::string& name) {
  if (name.size() > kMaxNameLength)
    throw std::invalid_argument("the name " + support::quoted(name) + " has " +
                                std::to_string(name.size()) + " characters; at most " +
                                std::to_string(kMaxNameLength) + " are allowed");
}

std::string name_item(const std::string& name) {
  check_name(name);
  return name.empty() ? "" : std::string(kNameItem) + quoted(name);
}

std::string formula_items(std::string_view kind, const Formula& formula,
                          const std::vector<double>& breaks) {
  std::string text = std::string(kind) + ":" + quoted(formula.text);
  for (const auto& [name, value] : formula.parameters)
    text += " param:" + name + "=" + support::number_text(value);
  for (const double r : breaks) text += " break:" + support::number_text(r);
  return text;
}

std::string tail_item(const TailFit& tail) {
  if (tail.kind == ProfileTail::none) return "";
  const auto named =
      std::ranges::find_if(kTails, [&](const NamedTail& t) { return t.kind == tail.kind; });
  return " tail:" + std::string(named->name) + "=" + support::number_text(tail.parameter);
}

// Reading.

/// What the line says.
struct Parts {
  std::string kind;    // kP22, kNdf, kProfile; or empty for a family
  std::string source;  // the formula, or the family with its parameters
  std::map<std::string, double> parameters;
  std::vector<double> breaks;
  std::optional<double> frozen_at, tail_parameter;
  ProfileTail tail = ProfileTail::none;
  std::string name;
};

class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text) {}

  Parts read() {
    if (text_.empty())
      throw std::invalid_argument(
          "the specification of the distribution is empty: a program made the tables of a "
          "distribution of its own, which only that program can make again");
    if (const auto control = std::ranges::find_if(text_, is_control); control != text_.end()) {
      at_ = static_cast<std::size_t>(control - text_.begin());
      fail("there is a control character; a specification is one line");
    }
    read_source();
    while (at_ < text_.size()) read_item();
    return std::move(parts_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::invalid_argument(why + " (column " + std::to_string(at_ + 1) +
                                " of the specification " + support::quoted(text_, at_) + ")");
  }

  void read_source() {
    for (const std::string_view kind : {kP22, kNdf})
      if (rest().starts_with(std::string(kind) + ":'")) {
        parts_.kind = kind;
        at_ += kind.size() + 1;
        parts_.source = read_quoted();
        return;
      }
    const std::string word(rest().substr(0, rest().find(' ')));
    if (word == kProfile) {
      parts_.kind = kProfile;
      at_ += word.size();
      return;
    }
    at_ = std::min(text_.find(kNameItem), text_.size());
    parts_.source = text_.substr(0, at_);
  }

  /// Reads one " key:value".
  void read_item() {
    if (text_[at_] != ' ') fail("a space is missing");
    ++at_;
    const std::size_t colon = rest().find(':');
    if (colon == std::string_view::npos) fail("an item KEY:VALUE has no ':'");
    const std::string key(rest().substr(0, colon));
    const bool formula = parts_.kind == kP22 || parts_.kind == kNdf;
    const std::size_t key_at = std::exchange(at_, at_ + colon + 1);
    if (key == "name") {
      once(key);
      parts_.name = read_quoted();
      check_name(parts_.name);
    } else if (key == "param" && formula) {
      read_parameter();
    } else if (key == "break" && formula) {
      parts_.breaks.push_back(number(read_word()));
    } else if (key == "frozen-at" && parts_.kind == kNdf) {
      once(key);
      parts_.frozen_at = number(read_word());
    } else if (key == "tail" && parts_.kind == kProfile) {
      once(key);
      read_tail();
    } else {
      at_ = key_at;
      fail("the item " + support::quoted(key) + " is unknown here; known: " + known_items());
    }
  }

  std::string known_items() const {
    if (parts_.kind == kP22) return "param, break, name";
    if (parts_.kind == kNdf) return "param, break, frozen-at, name";
    return parts_.kind == kProfile ? "tail, name" : "name";
  }

  void once(const std::string& key) {
    if (std::ranges::find(seen_, key) != seen_.end())
      fail(support::quoted(key) + " is given twice");
    seen_.push_back(key);
  }

  void read_parameter() {
    const std::string word = read_word();
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) fail("a parameter is not NAME=NUMBER");
    if (!parts_.parameters.emplace(word.substr(0, equals), number(word.substr(equals + 1))).second)
      fail("the parameter " + support::quoted(word.substr(0, equals)) + " is given twice");
  }

  void read_tail() {
    const std::string word = read_word();
    const std::size_t equals = std::min(word.find('='), word.size());
    const auto named = std::ranges::find_if(
        kTails, [&](const NamedTail& t) { return t.name == word.substr(0, equals); });
    if (named == kTails.end()) fail("a tail is none, exponential or power");
    parts_.tail = named->kind;
    if (equals < word.size()) parts_.tail_parameter = number(word.substr(equals + 1));
  }

  std::string_view rest() const { return std::string_view(text_).substr(at_); }

  /// Reads up to the next space.
  std::string read_word() {
    const std::size_t begin = at_;
    at_ = std::min(text_.find(' ', at_), text_.size());
    return text_.substr(begin, at_ - begin);
  }

  std::string read_quoted() {
    if (!rest().starts_with('\'')) fail("a text in single quotes is missing");
    std::string result;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\'' && !rest().starts_with("''")) {
        ++at_;
        return result;
      }
      if (text_[at_] == '\'') ++at_;
      result += text_[at_];
    }
    fail("the quote at the end of a text is missing");
  }

  double number(const std::string& word) const {
    const auto value = support::finite_number(word);
    if (!value) fail(support::quoted(word) + " is not a finite number");
    return *value;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  Parts parts_;
  std::vector<std::string> seen_;
};

// Making.

std::unique_ptr<SlopeDistribution> make_p22(const Parts& parts) {
  return std::make_unique<FormulaDistribution>(
      FormulaDistribution::from_p22({parts.source, parts.parameters}, parts.breaks));
}

void require_use_of_alpha(const NdfFormula& ndf, std::optional<double> frozen_at) {
  if (frozen_at && !ndf.uses_alpha())
    throw std::invalid_argument("the formula " + support::quoted(ndf.text()) +
                                " does not use alpha, so it cannot be frozen at an alpha; leave "
                                "that out");
}

std::unique_ptr<SlopeDistribution> make_ndf(const Parts& parts) {
  const NdfFormula ndf({parts.source, parts.parameters});
  require_use_of_alpha(ndf, parts.frozen_at);
  if (ndf.uses_alpha() && !parts.frozen_at) require_shape_invariant(ndf, ndf.text());
  return std::make_unique<FormulaDistribution>(
      FormulaDistribution::from_ndf(ndf, parts.frozen_at.value_or(1), parts.breaks));
}

std::unique_ptr<SlopeDistribution> make_kind(const Parts& parts, const Specification& s) {
  if (parts.kind == kP22) return make_p22(parts);
  if (parts.kind == kNdf) return make_ndf(parts);
  if (parts.kind == kProfile)
    return std::make_unique<MeasuredProfile>(parts.name, RadialProfile{s.r, s.p22}, parts.tail,
                                             parts.tail_parameter);
  return parse_distribution(parts.source);
}

/// Gives `d` the name. A mixture of it alone is the same distribution, bit for bit.
std::unique_ptr<SlopeDistribution> under_name(std::unique_ptr<SlopeDistribution> d,
                                              const std::string& name) {
  if (name.empty() || name == d->name()) return d;
  return std::make_unique<Mixture>(
      std::vector<Mixture::Component>{{.weight = 1, .distribution = std::move(d)}}, name);
}

}  // namespace

Specification specify_family(const std::string& text, const std::string& name) {
  return {parse_distribution(text)->name() + name_item(name)};
}

Specification specify_p22(const Formula& formula, const std::vector<double>& breaks,
                          const std::string& name) {
  FormulaDistribution::from_p22(formula, breaks);  // throws if anything is wrong
  return {formula_items(kP22, formula, breaks) + name_item(name)};
}

Specification specify_ndf(const Formula& formula, std::optional<double> frozen_at,
                          const std::vector<double>& breaks, const std::string& name) {
  const NdfFormula ndf(formula);
  require_use_of_alpha(ndf, frozen_at);
  FormulaDistribution::from_ndf(ndf, frozen_at.value_or(1), breaks);  // throws likewise
  std::string text = formula_items(kNdf, formula, breaks);
  if (frozen_at) text += " frozen-at:" + support::number_text(*frozen_at);
  return {text + name_item(name)};
}

Specification specify_profile(const MeasuredProfile& profile) {
  return {std::string(kProfile) + tail_item(profile.tail()) + name_item(profile.name()),
          profile.samples().r, profile.samples().p22};
}

std::unique_ptr<SlopeDistribution> make_distribution(const Specification& specification) {
  const Parts parts = Reader(specification.text).read();
  if (parts.kind != kProfile && !(specification.r.empty() && specification.p22.empty()))
    throw std::invalid_argument("the specification " + support::quoted(specification.text) +
                                " has samples, which belong to a profile only");
  auto distribution = under_name(make_kind(parts, specification), parts.name);
  // A family may be infinite at slope 0 because its integrals are known to exist.
  const bool singular = parts.kind.empty() && std::isinf(distribution->p22(0));
  diagnose(*distribution, {.singularity_at_zero_allowed = singular});
  return distribution;
}

}  // namespace vndf::distributions
