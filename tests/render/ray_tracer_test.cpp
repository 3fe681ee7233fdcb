// Rays against shapes whose points are known.
#include "render/ray_tracer.h"

#include <cmath>
#include <limits>

#include "support/catch.h"

using namespace vndf;
using namespace vndf::render;

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("a ray meets the nearest of two meshes, with their normals and tangents", "[render]") {
  const Mesh near = rectangle({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}),
             far = box({-2, -2, -1}, {2, 2, 0});
  const RayTracer tracer({&far, &near});
  const auto hit = tracer.nearest({{0.25f, 0.5f, 3}, {0, 0, -1}});
  REQUIRE(hit);
  CHECK(hit->mesh == 1);
  CHECK(hit->distance == Approx(2));
  CHECK(length(hit->position - Vector{0.25f, 0.5f, 1}) < 1e-5f);
  CHECK(length(hit->normal - Vector{0, 0, 1}) < 1e-6f);
  CHECK(length(hit->face - Vector{0, 0, 1}) < 1e-6f);
  CHECK(length(normalize_or_up(hit->tangent) - Vector{1, 0, 0}) < 1e-6f);
  CHECK(tracer.nearest({{1.5f, 0, 3}, {0, 0, -1}})->mesh == 0);
  CHECK(!tracer.nearest({{0, 0, 3}, {0, 0, 1}}));
}

TEST_CASE("a shadow ray is blocked by what is before its end only", "[render]") {
  const Mesh mesh = rectangle({-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
  const RayTracer tracer({&mesh});
  const Ray up{{0, 0, 0}, {0, 0, 1}};
  CHECK(tracer.blocked(up, kFar));
  CHECK(tracer.blocked(up, 1.01f));
  CHECK(!tracer.blocked(up, 0.99f));
  CHECK(!tracer.blocked({{0, 0, 0}, {0, 0, -1}}, kFar));
}

TEST_CASE("normals of a ball are smooth though it has facets", "[render]") {
  const Mesh mesh = revolved(half_circle(1, 0));
  const RayTracer tracer({&mesh});
  for (int i = 0; i < 50; ++i) {
    const Vector from = 3 * normalize_or_up(Vector{std::cos(static_cast<float>(i)),
                                                   std::sin(1.7f * static_cast<float>(i)),
                                                   std::cos(2.3f * static_cast<float>(i))});
    const auto hit = tracer.nearest({from, normalize_or_up(-from)});
    REQUIRE(hit);
    CHECK(length(hit->normal - (1.0f / 3) * from) < 1e-3f);
    CHECK(dot(hit->face, hit->normal) > 0.999f);
  }
}

TEST_CASE("a ray that leaves a face does not meet it again", "[render]") {
  const Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
  const RayTracer tracer({&mesh});
  for (int i = 0; i < 1000; ++i) {
    const float a = 0.7f * static_cast<float>(i), x = std::cos(a), y = std::sin(3 * a);
    const auto hit = tracer.nearest({{0.9f * x, 0.9f * y, 5}, {0, 0, -1}});
    REQUIRE(hit);
    const Vector up = normalize_or_up(Vector{x, y, 0.01f});
    REQUIRE(!tracer.nearest(leaving(hit->position, hit->face, up)));
    // Into the box, it meets another face.
    REQUIRE(tracer.nearest(leaving(hit->position, hit->face, -up))->distance > 0.05f);
  }
}
