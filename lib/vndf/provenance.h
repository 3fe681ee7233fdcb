// Where tables came from. Every file of tables carries this, so that the distribution can be made
// again anywhere: a validator must know the distribution that a sampler claims to follow.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vndf/surface_slopes.h"

namespace vndf {

/// Names a slope distribution completely. distributions::make_distribution() makes it.
struct Specification {
  /// One line, such as "student-t:gamma=3" or "p22:'exp(-k*r)' param:k=2". The grammar is in
  /// vndf/distributions/specification.h. Empty where a program made the tables of a distribution of
  /// its own, which nothing but that program can make again.
  std::string text;
  /// The samples of a measured profile, as many radii as densities: p22[i] at slope radius r[i].
  /// Empty for every other kind.
  std::vector<double> r = {}, p22 = {};

  bool operator==(const Specification&) const = default;
};

/// Limits of both formats of files. HDF5 holds texts of just under 64 KiB.
inline constexpr std::size_t kMaxTextBytes = 60000, kMaxSamples = 1u << 20;

struct Provenance {
  Specification specification;
  std::string command = {};  ///< how the file was made, for people; nothing reads it
  std::string program = {};  ///< name and version of the program that wrote the file
  std::string notes = {};    ///< what was found while it was made, for people; lines, or empty
  /// The surface of the map that the distribution was estimated from, in units of the distribution:
  /// what was taken out of the map, so that a renderer can put it back (OnSurface). Nothing where
  /// the distribution is not from a map.
  std::optional<SurfaceSlopes> surface = {};

  bool operator==(const Provenance&) const = default;
};

/// Returns the first rule that is broken, for a message, or nothing: as many radii as densities,
/// kMaxSamples at most and all finite; texts of at most kMaxTextBytes without a zero byte or a
/// control character; a surface that check(SurfaceSlopes) accepts.
std::optional<std::string> check(const Provenance& provenance);

/// The same rule for one text, which the message calls `name`.
std::optional<std::string> check_text(const std::string& name, const std::string& text);

/// Whether a text in UTF-8 has a control character other than a zero byte and the end of a line:
/// C0 with the tabulator, DEL or C1. Texts of files are printed, and these would drive the
/// terminal.
bool has_control_character(std::string_view text);

}  // namespace vndf
