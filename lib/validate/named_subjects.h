// The reference samplers that can be judged by name. A new sampler is one line of the list.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "validate/subject.h"

namespace vndf::validate {

struct NamedSubject {
  std::string name;
  std::string distribution;  ///< the specification of the law that it claims
  std::function<Subject(std::string name, std::shared_ptr<const SlopeLaw> law)> make;
};

/// All of them, in the order to show.
const std::vector<NamedSubject>& named_subjects();

/// The one called `name`. Throws std::invalid_argument, naming the nearest known one.
const NamedSubject& find_subject(const std::string& name);

/// An entry of the list: `Sampler<T>`, made without arguments in both precisions.
template <template <class> class Sampler>
NamedSubject reference(std::string name, std::string distribution, const Claims& claims,
                       const Bounds& bounds = {}) {
  return {std::move(name), std::move(distribution),
          [claims, bounds](std::string subject, std::shared_ptr<const SlopeLaw> law) {
            return make_subject(std::move(subject), std::move(law), Sampler<float>{},
                                Sampler<double>{}, claims, bounds);
          }};
}

}  // namespace vndf::validate
