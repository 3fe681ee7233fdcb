// Counts of uniform numbers, and what they say.
#include "vndf/validate/statistics/uniformity.h"

#include <algorithm>
#include <cmath>

#include "vndf/support/text.h"
#include "vndf/validate/statistics/significance.h"

namespace vndf::validate {
namespace {

constexpr double kFewestInBin = 5;

bool is_prime(std::size_t n) {
  if (n < 2) return false;
  for (std::size_t k = 2; k * k <= n; ++k)
    if (n % k == 0) return false;
  return true;
}

/// The largest prime up to `n`, or 2.
std::size_t prime_to(double n) {
  auto k = static_cast<std::size_t>(std::max(2.0, n));
  while (!is_prime(k)) --k;
  return k;
}

std::size_t bin_of(double w, std::size_t bins) {
  const double scaled = w * static_cast<double>(bins);
  return scaled > 0 ? std::min(static_cast<std::size_t>(scaled), bins - 1) : 0;
}

double pearson(const std::vector<std::uint64_t>& counts, double samples) {
  const double expected = samples / static_cast<double>(counts.size());
  double sum = 0;
  for (const auto count : counts) {
    const double excess = static_cast<double>(count) - expected;
    sum += excess * excess / expected;
  }
  return sum;
}

/// The relative error that is declared for the tail of mass `e`. It grows with the logarithm of the
/// mass, from that of the density in the middle to that of the tail at 1e-6 and on.
double declared_at(const DeclaredErrors& declared, double e) {
  const double depth = std::log(e) / std::log(1e-6);
  return declared.density + declared.tail * depth;
}

CheckResult probability(const std::string& check, const std::string& statistic, double p,
                        std::size_t tests, const Place& where, std::string note) {
  return {check, statistic, Kind::probability, p, 0, where, tests, std::move(note)};
}

}  // namespace

BinCounts bins_for(std::uint64_t samples) {
  const double most = static_cast<double>(samples) / kFewestInBin;
  if (most >= static_cast<double>(kSideR * kSidePhi)) return {kBins, kSideR, kSidePhi};
  const std::size_t side = prime_to(std::sqrt(most));
  return {prime_to(most), side, side};
}

LineCounts::LineCounts(std::size_t bins) : bins_(bins) {}

void LineCounts::add(double w) {
  ++samples_;
  ++bins_[bin_of(w, bins_.size())];
  constexpr double kTail = 1.0 / (1 << kFirstOctave);
  if (w >= kTail && w <= 1 - kTail) return;
  // frexp: w = f 2^e with f in [1/2, 1), that is the octave [2^(e-1), 2^e)
  const auto count = [](auto& octaves, double tail) {
    int e = 0;
    std::frexp(tail, &e);
    const int octave = -e - kFirstOctave;
    if (tail > 0 && octave >= 0 && octave < kOctaves)
      ++octaves[static_cast<std::size_t>(octave)];
    else if (!(tail > 0) || octave >= kOctaves)
      ++octaves[kOctaves - 1];
  };
  w < 0.5 ? count(lower_, w) : count(upper_, 1 - w);
}

void LineCounts::add(const LineCounts& other) {
  samples_ += other.samples_;
  for (std::size_t k = 0; k < bins_.size(); ++k) bins_[k] += other.bins_[k];
  for (std::size_t k = 0; k < kOctaves; ++k) {
    lower_[k] += other.lower_[k];
    upper_[k] += other.upper_[k];
  }
}

double LineCounts::pearson() const {
  return validate::pearson(bins_, static_cast<double>(samples_));
}

double LineCounts::chi_square(const DeclaredErrors& declared) const {
  return chi_square_p(pearson(), bins_.size(), static_cast<double>(samples_), declared.density);
}

double LineCounts::distance() const {
  const auto n = static_cast<double>(samples_), bins = static_cast<double>(bins_.size());
  std::uint64_t below = 0;
  double largest = 0;
  for (std::size_t k = 0; k < bins_.size(); ++k) {
    below += bins_[k];
    const double exact = static_cast<double>(k + 1) / bins;
    largest = std::max(largest, std::abs(static_cast<double>(below) / n - exact));
  }
  return largest;
}

double LineCounts::cumulative(const DeclaredErrors& declared) const {
  return cumulative_p(distance(), static_cast<double>(samples_), declared.u);
}

std::size_t LineCounts::octaves() const {
  const double most =
      std::log2(static_cast<double>(samples_) / static_cast<double>(kFewest)) - kFirstOctave;
  return most < 1 ? 0 : std::min(static_cast<std::size_t>(most), std::size_t{kOctaves});
}

double LineCounts::tails(const DeclaredErrors& declared, double& ratio) const {
  const auto n = static_cast<double>(samples_);
  double smallest = 1;
  ratio = 1;
  const auto test = [&](std::uint64_t seen, double mass) {
    const double p = binomial_p(seen, samples_, mass, declared_at(declared, mass));
    if (p >= smallest) return;
    smallest = p;
    ratio = static_cast<double>(seen) / (n * mass);
  };
  const std::size_t octaves = this->octaves();
  for (const auto* end : {&lower_, &upper_})
    for (std::size_t k = 0; k < octaves; ++k) {
      // The last octave stands for everything beyond it: nothing is left out.
      const double from = std::ldexp(1.0, -kFirstOctave - static_cast<int>(k));
      if (k + 1 < octaves) {
        test((*end)[k], from / 2);
        continue;
      }
      std::uint64_t rest = 0;
      for (std::size_t j = k; j < kOctaves; ++j) rest += (*end)[j];
      test(rest, from);
    }
  return smallest;
}

UniformCounts::UniformCounts(const BinCounts& bins)
    : side_r_(bins.side_r),
      side_phi_(bins.side_phi),
      r_(bins.line),
      phi_(bins.line),
      x_(bins.line),
      square_(bins.side_r * bins.side_phi) {}

void UniformCounts::add(const Uniforms& w) {
  r_.add(w.r);
  phi_.add(w.phi);
  x_.add(w.x);
  ++square_[bin_of(w.r, side_r_) * side_phi_ + bin_of(w.phi, side_phi_)];
}

void UniformCounts::add(const UniformCounts& other) {
  r_.add(other.r_);
  phi_.add(other.phi_);
  x_.add(other.x_);
  for (std::size_t k = 0; k < square_.size(); ++k) square_[k] += other.square_[k];
}

double UniformCounts::square_p(const DeclaredErrors& declared) const {
  const auto n = static_cast<double>(r_.samples());
  return chi_square_p(pearson(square_, n), square_.size(), n, declared.density);
}

std::vector<CheckResult> UniformCounts::results(const DeclaredErrors& declared,
                                                const std::string& check,
                                                const Place& where) const {
  std::vector<CheckResult> list;
  const auto line = [&](const LineCounts& counts, const std::string& name) {
    double ratio = 1;
    list.push_back(probability(check, name + " cdf", counts.cumulative(declared), 1, where,
                               "distance " + support::rounded_text(counts.distance())));
    list.push_back(probability(check, name + " chi-square", counts.chi_square(declared), 1, where,
                               std::to_string(counts.samples()) + " samples"));
    if (counts.octaves() == 0) return;
    const double tails = counts.tails(declared, ratio);
    list.push_back(probability(check, name + " tails", tails, 2 * counts.octaves(), where,
                               "mass ratio " + support::rounded_text(ratio)));
  };
  line(r_, "radius");
  line(phi_, "azimuth");
  line(x_, "slope x");
  list.push_back(probability(check, "sphere chi-square", square_p(declared), 1, where,
                             std::to_string(square_.size()) + " cells"));
  return list;
}

std::size_t number_of_tests(const std::vector<CheckResult>& results) {
  std::size_t tests = 0;
  for (const CheckResult& f : results) tests += f.tests;
  return tests;
}

void bound_probabilities(std::vector<CheckResult>& results, double significance,
                         std::size_t tests) {
  for (CheckResult& f : results)
    if (f.kind == Kind::probability) f.bound = sidak(significance, tests);
}

void merge_results(std::vector<CheckResult>& all, const std::vector<CheckResult>& more) {
  for (const CheckResult& f : more) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const CheckResult& a) {
      return a.check == f.check && a.statistic == f.statistic;
    });
    if (same == all.end()) {
      all.push_back(f);
      continue;
    }
    const std::size_t tests = same->tests + f.tests;
    const bool worse =
        f.kind == Kind::error ? !(f.measured <= same->measured) : !(f.measured >= same->measured);
    if (worse) *same = f;
    same->tests = tests;
  }
}

}  // namespace vndf::validate
