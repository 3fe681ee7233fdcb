// The smallest tables that keep a tolerance.
#include "precompute/smallest_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "precompute/measure_certificate.h"

namespace vndf::precompute {
namespace {

constexpr std::size_t kSides[] = {8,   12,  16,  20,  24,  28,  32,  40,  48,  56,
                                  64,  72,  80,  96,  112, 128, 160, 192, 224, 256,
                                  320, 384, 448, 512, 640, 768, 896, 1024};
constexpr double kUnits[] = {1, 2, 4, 8, 16, 32};
constexpr std::size_t kUnitSide = 64;  // of the tables by which a unit is chosen
constexpr std::size_t kMapNodesPerColumn = 4;
// Rows and columns of the shapes that are tried, in this order, as multiples of a side.
constexpr std::size_t kAspects[][2] = {{1, 1}, {2, 1}, {1, 2}, {4, 1}, {8, 1}};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One table of the two, at some layout.
struct Candidate {
  SlopeTables tables;
  double error = kInfinity;
  std::size_t bytes = 0;
};

/// Makes and measures the table at a layout.
using Maker = std::function<Candidate(const TableLayout&)>;

class Search {
 public:
  Search(Maker make, const SmallestOptions& options) : make_(std::move(make)), options_(options) {}

  /// The smallest table within the tolerance or, failing that, the best that was seen.
  Candidate run(bool one_row) {
    for (const RowBlend blend : {RowBlend::cubic, RowBlend::linear})
      for (const auto& [rows, columns] : kAspects)
        if (const auto found = smallest({rows, columns, blend}, one_row)) return *found;
    return best_;
  }

 private:
  bool good(const Candidate& c) const {
    return c.error <= options_.tolerance && c.bytes <= options_.max_bytes;
  }

  Candidate made(const TableLayout& layout) {
    Candidate c = make_(layout);
    if (c.bytes <= options_.max_bytes && c.error < best_.error) best_ = c;
    return c;
  }

  /// The smallest side at which `layout_of(side)` is good, by bisection: errors fall with size.
  template <class LayoutOf>
  std::optional<std::pair<TableLayout, Candidate>> smallest_side(LayoutOf layout_of,
                                                                 std::size_t last) {
    std::optional<std::pair<TableLayout, Candidate>> found;
    std::size_t low = 0, high = last;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      const TableLayout layout = layout_of(kSides[middle]);
      Candidate c = made(layout);
      const bool fits = good(c);
      if (fits) found = {layout, std::move(c)};
      // Too large is no reason to look among larger ones.
      (fits || c.bytes > options_.max_bytes ? high : low) =
          fits || c.bytes > options_.max_bytes ? middle : middle + 1;
    }
    return found;
  }

  /// Tables of `shape` times a side first; of the smallest, fewer rows, and then fewer columns.
  std::optional<Candidate> smallest(const TableLayout& shape, bool one_row) {
    const auto with = [&](std::size_t rows, std::size_t columns) {
      return TableLayout{one_row ? 1 : rows, columns, shape.blend};
    };
    const auto sides_below = [](std::size_t side) {
      return static_cast<std::size_t>(std::lower_bound(std::begin(kSides), std::end(kSides), side) -
                                      std::begin(kSides));
    };
    auto found = smallest_side(
        [&](std::size_t side) { return with(shape.rows * side, shape.columns * side); },
        std::size(kSides));
    if (!found || one_row) return found ? std::optional(found->second) : std::nullopt;
    const std::size_t columns = found->first.columns;
    if (auto fewer = smallest_side([&](std::size_t n) { return with(n, columns); },
                                   sides_below(found->first.rows)))
      found = fewer;
    const std::size_t rows = found->first.rows;
    if (auto fewer =
            smallest_side([&](std::size_t n) { return with(rows, n); }, sides_below(columns)))
      found = fewer;
    return found->second;
  }

  Maker make_;
  const SmallestOptions& options_;
  Candidate best_;
};

/// Tables of a single cell in place of the table that is not being measured.
QuantileTable nothing(Tangents tangents) {
  return {1, 3, std::vector<float>{0, 0.5f, 1}, RowBlend::linear, tangents};
}

Maker marginal_maker(const UnitSlopes& slopes, const SlopeTables& frame, bool mapped,
                     const Workers& workers) {
  return [&slopes, &frame, mapped, workers](const TableLayout& layout) {
    Candidate c{frame};
    if (mapped)
      set_mapped_marginal(c.tables, slopes, layout, kMapNodesPerColumn * layout.columns, workers);
    else
      set_plain_marginal(c.tables, slopes, layout, workers);
    c.tables.conditional = nothing(Tangents::five_points_even);
    const auto shared = share(c.tables);
    c.error = measure_marginal(slopes, shared, workers).max_u_error;
    c.bytes = sampling_bytes(c.tables);
    return c;
  };
}

Maker conditional_maker(const UnitSlopes& slopes, const SlopeTables& frame,
                        const ConditionalShape& shape, double unit, const Workers& workers) {
  return [&slopes, &frame, &shape, unit, workers](const TableLayout& layout) {
    Candidate c{frame};
    set_conditional(c.tables, slopes, shape, unit, layout, workers);
    c.tables.marginal = nothing(Tangents::five_points);
    const TableErrors errors = measure_conditional(slopes, share(c.tables), workers);
    // One row costs next to nothing, so its tails are to be right too.
    c.error = shape.factorises ? fault(errors) : errors.max_u_error;
    c.bytes = sampling_bytes(c.tables);
    return c;
  };
}

/// The unit that serves best at a middling size.
double best_unit(const UnitSlopes& slopes, const SlopeTables& frame, const ConditionalShape& shape,
                 const Workers& workers) {
  if (shape.factorises) return 1;
  double best = 1, least = kInfinity;
  for (const double unit : kUnits) {
    const Maker make = conditional_maker(slopes, frame, shape, unit, workers);
    const double error = make({kUnitSide, kUnitSide, RowBlend::cubic}).error;
    if (error < least) {
      least = error;
      best = unit;
    }
  }
  return best;
}

/// The smallest marginal table of either kind: a map costs bytes and saves columns.
Candidate smallest_marginal(const UnitSlopes& slopes, const SlopeTables& frame,
                            const SmallestOptions& options) {
  const Workers workers{options.threads};
  Candidate plain = Search(marginal_maker(slopes, frame, false, workers), options).run(false);
  Candidate mapped = Search(marginal_maker(slopes, frame, true, workers), options).run(false);
  const bool both = std::max(plain.error, mapped.error) <= options.tolerance;
  const bool take_plain = both ? plain.bytes <= mapped.bytes : plain.error < mapped.error;
  return take_plain ? std::move(plain) : std::move(mapped);
}

void require(const Candidate& c, const char* table, const SmallestOptions& options) {
  if (c.error <= options.tolerance) return;
  std::ostringstream why;
  why << "no " << table << " table of at most " << options.max_bytes
      << " bytes keeps the tolerance " << options.tolerance << ": ";
  if (std::isfinite(c.error))
    why << "the nearest errs by " << c.error << " in u with " << c.bytes
        << " bytes; allow more bytes or a larger tolerance";
  else
    why << "none that was tried is so small; allow more bytes";
  throw std::runtime_error(why.str());
}

}  // namespace

BuiltTables smallest_tables(const SlopeDistribution& distribution, const SmallestOptions& options) {
  const Workers workers{options.threads};
  const UnitSlopes slopes(distribution, workers);
  const SlopeTables frame = tables_without_rows(slopes, workers);
  const ConditionalShape shape = conditional_shape(slopes);

  Candidate marginal = smallest_marginal(slopes, frame, options);
  require(marginal, "marginal", options);
  const double unit = best_unit(slopes, frame, shape, workers);
  const Candidate conditional =
      Search(conditional_maker(slopes, frame, shape, unit, workers), options).run(shape.factorises);
  require(conditional, "conditional", options);

  SlopeTables tables = std::move(marginal.tables);
  tables.conditional = conditional.tables.conditional;
  tables.conditional_rows = conditional.tables.conditional_rows;
  tables.conditional_constant = conditional.tables.conditional_constant;
  tables.conditional_quadratic = conditional.tables.conditional_quadratic;
  tables.conditional_unit = conditional.tables.conditional_unit;
  const std::size_t bytes = sampling_bytes(tables);
  if (bytes > options.max_bytes)
    throw std::runtime_error("tables within the tolerance take " + std::to_string(bytes) +
                             " bytes, more than " + std::to_string(options.max_bytes) +
                             "; allow more bytes or a larger tolerance");
  BuiltTables built{share(std::move(tables)), {}, slopes.mass(), slopes.quadrature_error()};
  built.certificate = measure_certificate(slopes, built.tables, workers);
  return built;
}

}  // namespace vndf::precompute
