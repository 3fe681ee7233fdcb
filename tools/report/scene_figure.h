// A figure of the experiment with scenes: one scene rendered with every way of sampling its rough
// surfaces, and what the pictures say in numbers.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render/image.h"
#include "render/image_error.h"

namespace vndf::tools {

/// A picture of the scene by one way of sampling.
struct SceneRendering {
  render::Image image = {};
  std::uint32_t samples = 0;      ///< of each pixel
  double seconds = 0;             ///< that rendering took
  render::ImageError error = {};  ///< against the reference of the figure
};

/// The ways of sampling, each beside its name for people.
enum class Way { previous, walter, visible, analytic };
inline constexpr std::array kWays{Way::previous, Way::walter, Way::visible, Way::analytic};

/// "previous method", and so on.
std::string name_of(Way way);

/// One rendering of each way.
class Comparison {
 public:
  SceneRendering& operator[](Way way) { return renderings_[static_cast<std::size_t>(way)]; }
  const SceneRendering& operator[](Way way) const {
    return renderings_[static_cast<std::size_t>(way)];
  }

  /// The relative MSE of the previous method over that of `way`. With unbiased samplers, both are
  /// variances.
  double variance_ratio(Way way) const;

 private:
  std::array<SceneRendering, kWays.size()> renderings_;
};

struct Reference {
  render::Image image = {};
  std::uint32_t samples = 0;
  double seconds = 0;
  double relative_mse = 0;  ///< of the reference itself (render::error_of_mean)
};

struct SceneFigure {
  std::string name;   ///< in names of files
  std::string title;  ///< plain text
  std::string setup;  ///< whole sentences: the scene, its light, what the paper shows of it
  Reference reference = {};
  Comparison equal_samples = {};
  Comparison equal_time = {};  ///< the time of visible normals by tables at equal samples
};

/// Names of files of EXR data: of the reference, and of a rendering of one of the two comparisons.
std::string reference_file(const SceneFigure& figure);
std::string equal_samples_file(const SceneFigure& figure, Way way);
std::string equal_time_file(const SceneFigure& figure, Way way);

/// A number of a rendering, for people.
struct NamedNumber {
  const char* name;
  std::string text;
};

/// What is told of a rendering, in the order of the columns of a table.
std::vector<NamedNumber> numbers_of(const Comparison& comparison, Way way);

/// All numbers of a figure as lines of text.
std::string describe(const SceneFigure& figure);

/// All numbers of a figure, with the names of its files.
nlohmann::ordered_json to_json(const SceneFigure& figure);

}  // namespace vndf::tools
