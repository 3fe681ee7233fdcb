// What every sampler returns for an input that a caller should not pass, as the docstrings of the
// samplers state it.
#pragma once

#include <limits>
#include <utility>

#include "support/catch.h"
#include "support/directions.h"

namespace vndf::test {

template <class Sampler>
void check_stated_results(const Sampler& s) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Vec3<float> up{0, 0, 1}, wi = direction_at<float>(40, 20);
  for (const Alpha<float> alpha : {Alpha<float>{0, 1}, {1, -1}, {nan, 1}, {1, INFINITY}}) {
    CHECK(same(s.sample(wi, alpha, 0.3f, 0.4f), up));
    CHECK(s.pdf(wi, up, alpha) == 0);
    CHECK(s.d(up, alpha) == 0);
    CHECK(s.lambda(wi, alpha) == 0);
    CHECK(s.g1(wi, alpha) == 0);
  }
  for (const Vec3<float> bad : {Vec3<float>{nan, 0, 1}, {0, nan, 1}, {0, 0, nan}}) {
    CHECK(same(s.sample(bad, {1, 1}, 0.3f, 0.4f), up));
    CHECK(s.pdf(bad, up, {1, 1}) == 0);
  }
  for (const auto& [wild, end] : {std::pair{nan, 0.0f}, {-2.0f, 0.0f}, {9.0f, 1.0f}}) {
    CHECK(same(s.sample(wi, {1, 1}, wild, 0.4f), s.sample(wi, {1, 1}, end, 0.4f)));
    CHECK(same(s.sample(wi, {1, 1}, 0.4f, wild), s.sample(wi, {1, 1}, 0.4f, end)));
  }
  CHECK(s.g1({1, 0, 0}, {1, 1}) == 0);
  CHECK(s.lambda({1, 0, 0}, {1, 1}) == INFINITY);
  CHECK(s.g1({0, 0, 1}, {1, 1}) == 1);
  CHECK(s.d({1, 0, 0}, {1, 1}) == 0);
  CHECK(s.d({0, 0.6f, -0.8f}, {1, 1}) == 0);
}

}  // namespace vndf::test
