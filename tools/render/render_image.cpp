// Renders a scene.
#include "render/render_image.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

#include "render/path_tracer.h"

namespace vndf::render {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The sum of the paths through a pixel, in double precision because there may be millions.
struct Sum {
  double r = 0, g = 0, b = 0;
};

/// The pixels of an image while paths are added to them.
class Film {
 public:
  Film(const PathTracer& tracer, const Camera& camera, const RenderOptions& options)
      : tracer_(tracer), camera_(camera), o_(options), sums_(o_.width * o_.height) {}

  /// Adds `count` paths to every pixel, one row for each piece of work.
  void add(std::uint32_t count, const support::Workers& workers) {
    support::parallel_for(o_.height, workers, [&](std::size_t y) {
      for (std::size_t x = 0; x < o_.width; ++x)
        for (std::uint32_t i = 0; i < count; ++i) add_path(x, y, samples_ + i);
    });
    samples_ += count;
  }

  std::uint32_t samples() const { return samples_; }

  Image image() const {
    Image image{o_.width, o_.height};
    const double scale = 1.0 / samples_;
    for (const Sum& s : sums_)
      image.pixels.push_back({static_cast<float>(s.r * scale), static_cast<float>(s.g * scale),
                              static_cast<float>(s.b * scale)});
    return image;
  }

 private:
  void add_path(std::size_t x, std::size_t y, std::uint32_t path) {
    const std::size_t pixel = y * o_.width + x;
    SampleSequence numbers(o_.seed, pixel, path);
    const Vec2<float> u = numbers.next_pair();
    const auto width = static_cast<float>(o_.width), height = static_cast<float>(o_.height);
    const Ray ray = camera_.ray((static_cast<float>(x) + u.x) / width,
                                (static_cast<float>(y) + u.y) / height, width / height);
    const Rgb radiance = tracer_.radiance(ray, numbers);
    Sum& sum = sums_[pixel];
    sum.r += static_cast<double>(radiance.r);
    sum.g += static_cast<double>(radiance.g);
    sum.b += static_cast<double>(radiance.b);
  }

  const PathTracer& tracer_;
  const Camera& camera_;
  const RenderOptions& o_;
  std::vector<Sum> sums_;
  std::uint32_t samples_ = 0;
};

/// How many paths the next pass may take so that the time is used up: no more than twice as many as
/// there were, because the first ones tell little of how long others take.
std::uint32_t next_pass(std::uint32_t done, double spent, double seconds) {
  if (done == 0) return 1;
  const double fit = (seconds - spent) / spent * done + 0.5;
  const double most = std::min(2.0 * done, std::numeric_limits<std::uint32_t>::max() - 1.0 - done);
  return static_cast<std::uint32_t>(std::clamp(fit, 0.0, std::max(most, 0.0)));
}

void fill_time(Film& film, const RenderOptions& o, Clock::time_point start) {
  const support::Workers silent{.threads = o.workers.threads};
  constexpr std::size_t kSteps = 1000;
  for (double spent = 0; const auto count = next_pass(film.samples(), spent, o.seconds);) {
    film.add(count, silent);
    spent = seconds_since(start);
    if (o.workers.progress)
      o.workers.progress(static_cast<std::size_t>(std::min(1.0, spent / o.seconds) * kSteps),
                         kSteps);
  }
}

}  // namespace

Rendering render(const Scene& scene, const RenderOptions& o) {
  if (o.width == 0 || o.height == 0 || (o.samples == 0 && !(o.seconds > 0)))
    throw std::invalid_argument("an image needs at least one pixel and one sample");
  const PathTracer tracer(scene, o.sample_lights);
  const Clock::time_point start = Clock::now();
  Film film(tracer, scene.camera, o);
  if (o.seconds > 0)
    fill_time(film, o, start);
  else
    film.add(o.samples, o.workers);
  return {film.image(), film.samples(), seconds_since(start)};
}

}  // namespace vndf::render
