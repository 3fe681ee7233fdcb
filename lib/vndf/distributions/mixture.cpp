// Mixtures: everything is a weighted sum of the components, each stretched by its roughness.
#include "vndf/distributions/mixture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "vndf/support/text.h"

namespace vndf::distributions {
namespace {

void require_positive(double value, const std::string& what, std::size_t index) {
  if (value > 0 && std::isfinite(value)) return;
  throw std::invalid_argument("mixture: " + what + " of component " + std::to_string(index + 1) +
                              " is " + support::number_text(value) +
                              "; it must be a finite number > 0");
}

std::string text_of(const Mixture::Component& c) {
  return support::number_text(c.weight) + "*" + c.distribution->name() +
         (c.roughness == 1 ? "" : std::string("@").append(support::number_text(c.roughness)));
}

}  // namespace

Mixture::Mixture(std::vector<Component> components, const std::string& name)
    : components_(std::move(components)) {
  if (components_.empty()) throw std::invalid_argument("mixture: it has no components");
  double total = 0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const Component& c = components_[i];
    if (!c.distribution)
      throw std::invalid_argument("mixture: component " + std::to_string(i + 1) +
                                  " has no distribution");
    require_positive(c.weight, "the weight", i);
    require_positive(c.roughness, "the roughness", i);
    name_ += (i == 0 ? "mixture:" : "+") + text_of(c);
    total += c.weight;
  }
  if (!name.empty()) name_ = name;
  for (auto& c : components_) c.weight /= total;
}

double Mixture::p22(double r) const {
  double sum = 0;
  for (const auto& c : components_)
    sum += c.weight * c.distribution->p22(r / c.roughness) / c.roughness / c.roughness;
  return sum;
}

bool Mixture::costly() const {
  return std::any_of(components_.begin(), components_.end(),
                     [](const Component& c) { return c.distribution->costly(); });
}

std::vector<double> Mixture::breaks() const {
  std::vector<double> all;
  for (const auto& c : components_)
    for (const double radius : c.distribution->breaks()) all.push_back(c.roughness * radius);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

double Mixture::support() const {
  double largest = 0;
  for (const auto& c : components_)
    largest = std::max(largest, c.roughness * c.distribution->support());
  return largest;
}

std::optional<Marginals> Mixture::marginals(double x) const {
  Marginals sum{0, 0, 0};
  for (const auto& c : components_) {
    const auto part = c.distribution->marginals(x / c.roughness);
    if (!part) return {};
    sum.p += c.weight / c.roughness * part->p;
    sum.q += c.weight * part->q;
    sum.m += c.weight * c.roughness * part->m;
  }
  return sum;
}

}  // namespace vndf::distributions
