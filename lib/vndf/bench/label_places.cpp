// Every candidate is compared with everything taken, which is fast enough for a few labels.
#include "vndf/bench/label_places.h"

#include <algorithm>

namespace vndf::bench {
namespace {

/// Readers do not connect a label with its mark beyond this distance, in heights of the label.
constexpr int kFarthest = 3;

constexpr Place kDirections[] = {{1, 0}, {-1, 0}, {0, 1},  {0, -1},
                                 {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

bool within(const Box& a, const Box& bounds) {
  return a.left >= bounds.left && a.right <= bounds.right && a.bottom >= bounds.bottom &&
         a.top <= bounds.top;
}

}  // namespace

Box box_around(const Place& middle, double width, double height) {
  return {middle.x - width / 2, middle.y - height / 2, middle.x + width / 2, middle.y + height / 2};
}

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

std::optional<Place> LabelPlaces::put(const std::vector<Place>& candidates, double width,
                                      double height) {
  for (const Place& candidate : candidates) {
    const Box box = box_around(candidate, width, height);
    if (!within(box, bounds_)) continue;
    if (std::ranges::any_of(taken_, [&](const Box& t) { return overlap(t, box); })) continue;
    take(box);
    return candidate;
  }
  return {};
}

std::optional<Place> LabelPlaces::put_beside(const Place& mark, double radius, double width,
                                             double height) {
  std::vector<Place> candidates;
  for (int away = 0; away < kFarthest; ++away)
    for (const Place& to : kDirections) {
      const double gap = radius + away * height / 2;
      candidates.push_back({mark.x + to.x * (gap + width / 2), mark.y + to.y * (gap + height / 2)});
    }
  return put(candidates, width, height);
}

}  // namespace vndf::bench
