// The reference samplers that can be validated by name. A new sampler is one line of the list.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "vndf/distributions/slope_distribution.h"
#include "vndf/validate/sampler/sampler_under_test.h"

namespace vndf::validate {

/// A reference sampler and the distribution that it claims.
struct NamedSampler {
  std::string name;
  /// The distribution of slopes that it claims, as text.
  std::string distribution;
  /// Makes that distribution.
  std::function<std::unique_ptr<distributions::SlopeDistribution>()> make_distribution;
  /// Makes the sampler under test, called `name`, whose exact slopes may be shared with others of
  /// the same distribution.
  std::function<SamplerUnderTest(std::string name, std::shared_ptr<const ExactSlopes> exact)> make;
};

/// All of them, in the order in which they are listed.
const std::vector<NamedSampler>& named_samplers();

/// The one called `name`. Throws std::invalid_argument, which suggests the nearest known name.
const NamedSampler& find_sampler(const std::string& name);

}  // namespace vndf::validate
