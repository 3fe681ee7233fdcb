// Samples each segment of a curve on several threads.
#include "vndf/precompute/make_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vndf/differences.h"

namespace vndf::precompute {
namespace {

using Segment = LogCurveSegment<double>;

// exp(700) and exp(-700) are in the range of double precision; this stands for infinity and 0.
constexpr double kLargestLog = 700;
// Breaks are approached to this fraction of the segment, so that each side of a jump is sampled on
// its own side.
constexpr double kInside = 1e-12;

Grading grading_of(std::size_t segment, std::size_t segments, const CurveOptions& options) {
  const bool unbounded = options.open && segment + 1 == segments;
  if (segment == 0 && unbounded) return options.cusp ? Grading::low : Grading::none;
  return unbounded ? Grading::low : Grading::both;
}

double value_at(const std::function<double(double)>& log_f, const Segment& s, double t) {
  const double low = s.begin > 0 ? kInside : 0;
  const double high = s.grading == Grading::both ? 1 - kInside : 1;
  const double z = std::clamp(graded_inverse(t, s.grading), low, high);
  const double log = log_f(s.begin + (s.end - s.begin) * z);
  return std::isnan(log) ? -kLargestLog : std::clamp(log, -kLargestLog, kLargestLog);
}

void set_tangents(std::vector<CubicNode<double>>& nodes) {
  const auto value = [&](std::size_t k) { return nodes[k].value; };
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k].tangent = derivative(kFivePoints, value, nodes.size(), k);
}

bool is_zero(const Segment& s) {
  return std::all_of(s.nodes.begin(), s.nodes.end(),
                     [](const auto& n) { return n.value <= -kLargestLog; });
}

}  // namespace

std::vector<double> segment_ends(const distributions::SlopeDistribution& d, double mean_slope,
                                 double end) {
  std::vector<double> ends{0};
  if (std::isinf(d.p22(0))) ends.push_back(kPoleSegment);
  for (const double r : d.breaks()) ends.push_back(std::asinh(r / mean_slope));
  if (std::isinf(d.support())) ends.push_back(std::max(end, ends.back() + 1));
  return ends;
}

LogCurve<double> make_curve(const std::function<double(double a)>& log_f,
                            const std::vector<double>& ends, const CurveOptions& options,
                            const support::Workers& workers) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    segments.push_back({ends[i], ends[i + 1], grading_of(i, ends.size() - 1, options),
                        std::vector<CubicNode<double>>(options.nodes)});
  const double step = 1 / static_cast<double>(options.nodes - 1);
  support::parallel_for(segments.size() * options.nodes, {workers.threads}, [&](std::size_t piece) {
    Segment& s = segments[piece / options.nodes];
    const std::size_t k = piece % options.nodes;
    s.nodes[k].value = value_at(log_f, s, step * static_cast<double>(k));
  });
  for (Segment& s : segments) set_tangents(s.nodes);
  std::erase_if(segments, is_zero);
  return {std::move(segments), options.open};
}

}  // namespace vndf::precompute
