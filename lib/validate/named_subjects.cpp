// The reference samplers that can be judged by name.
#include "validate/named_subjects.h"

#include <algorithm>
#include <stdexcept>

#include "precompute/words.h"

namespace vndf::validate {

const std::vector<NamedSubject>& named_subjects() {
  static const std::vector<NamedSubject> list{};
  return list;
}

const NamedSubject& find_subject(const std::string& name) {
  const auto& list = named_subjects();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const NamedSubject& s) { return s.name == name; });
  if (found != list.end()) return *found;
  std::vector<std::string> known;
  for (const NamedSubject& s : list) known.push_back(s.name);
  throw std::invalid_argument("'" + name + "' is neither a table file nor a reference sampler" +
                              precompute::did_you_mean(name, known) +
                              "; known: " + precompute::listed(known));
}

}  // namespace vndf::validate
