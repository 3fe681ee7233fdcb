// Places the labels of a picture so that none covers another label or a mark.
#pragma once

#include <optional>
#include <vector>

namespace vndf::bench {

struct Place {
  double x, y;
};

struct Box {
  double left, bottom, right, top;
};

/// The box of a width and a height around its middle.
Box box_around(const Place& middle, double width, double height);

/// Whether two boxes share more than an edge.
bool overlap(const Box& a, const Box& b);

/// A greedy placement: a label that has a place keeps it.
class LabelPlaces {
 public:
  explicit LabelPlaces(const Box& bounds) : bounds_(bounds) {}

  /// Keeps labels away from `taken`, as from a mark.
  void take(const Box& taken) { taken_.push_back(taken); }

  /// Takes the first of the `candidates` for the middle of a label at which the label lies within
  /// the bounds and overlaps nothing taken, and returns it. Returns nothing if no candidate fits.
  std::optional<Place> put(const std::vector<Place>& candidates, double width, double height);

  /// The same for a label beside a mark of `radius` at `mark`. The candidates are at its sides,
  /// then at its corners, then farther away.
  std::optional<Place> put_beside(const Place& mark, double radius, double width, double height);

 private:
  Box bounds_;
  std::vector<Box> taken_;
};

}  // namespace vndf::bench
