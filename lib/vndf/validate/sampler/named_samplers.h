// The reference samplers that can be judged by name. A new sampler is one line of the list.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

struct NamedSubject {
  std::string name;
  /// The law that it claims, in words, and as a distribution.
  std::string distribution;
  std::function<std::unique_ptr<distributions::SlopeDistribution>()> make_distribution;
  /// Of that law, which may be shared.
  std::function<Subject(std::string name, std::shared_ptr<const SlopeLaw> law)> make;
};

/// All of them, in the order to show.
const std::vector<NamedSubject>& named_subjects();

/// The one called `name`. Throws std::invalid_argument, naming the nearest known one.
const NamedSubject& find_subject(const std::string& name);

}  // namespace vndf::validate
