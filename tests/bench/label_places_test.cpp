// Labels that are placed lie on nothing; where there is no room there is no label.
#include "vndf/bench/label_places.h"

#include <random>

#include "support/catch.h"

using namespace vndf::bench;

TEST_CASE("boxes overlap if they share more than an edge") {
  const Box box{0, 0, 2, 1};
  CHECK(overlap(box, {1, 0.5, 3, 2}));
  CHECK(overlap(box, box));
  CHECK_FALSE(overlap(box, {2, 0, 3, 1}));
  CHECK_FALSE(overlap(box, {0, 1, 2, 2}));
}

TEST_CASE("a label takes its first free candidate within the bounds") {
  LabelPlaces places({0, 0, 10, 10});
  places.take({4, 4, 6, 6});
  const auto p = places.put({{-1, 5}, {5, 5}, {2, 8}, {8, 2}}, 2, 2);
  REQUIRE(p.has_value());
  CHECK(p->x == 2);
  CHECK(p->y == 8);
  CHECK(places.put({{2, 8}, {8, 2}}, 2, 2)->x == 8);
  CHECK_FALSE(places.put({{2, 8}, {8, 2}}, 2, 2).has_value());
}

TEST_CASE("a label goes beside its mark, to the right where that is free") {
  LabelPlaces places({0, 0, 100, 100});
  const auto right = places.put_beside({50, 50}, 5, 12, 10);
  REQUIRE(right.has_value());
  CHECK(right->x == 61);
  CHECK(right->y == 50);
  CHECK(places.put_beside({50, 50}, 5, 12, 10)->x == 39);
}

TEST_CASE("among crowded marks no label lies on another, on a mark or out of bounds") {
  constexpr double kRadius = 4, kWidth = 12, kHeight = 10;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at(0, 300);
  std::vector<Place> marks(200);
  for (Place& m : marks) m = {at(random), at(random)};

  LabelPlaces places({0, 0, 300, 300});
  std::vector<Box> taken;
  for (const Place& m : marks) {
    taken.push_back(box_around(m, 2 * kRadius, 2 * kRadius));
    places.take(taken.back());
  }
  std::size_t labels = 0;
  for (const Place& m : marks) {
    const auto p = places.put_beside(m, kRadius, kWidth, kHeight);
    if (!p) continue;
    const Box label = box_around(*p, kWidth, kHeight);
    for (const Box& other : taken) REQUIRE_FALSE(overlap(label, other));
    CHECK((label.left >= 0 && label.bottom >= 0 && label.right <= 300 && label.top <= 300));
    taken.push_back(label);
    ++labels;
  }
  CHECK(labels > 100);
}
