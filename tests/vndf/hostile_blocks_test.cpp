// Blocks that were made to do harm, under right checksums, as anybody can make them: fields and
// entries with extreme numbers, random bytes, cuts. Each is refused by a rule or samples as any
// block does, and nothing outside its bytes is read. They lie in memory of just their size, so that
// the sanitizers, with which tools/sanitize.sh runs this, see a byte too far. Together they are
// 1e5.
//
// VNDF_TEST_MUTANTS sets how many random ones there are, and VNDF_TEST_SEED others.
#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "support/baked_tables.h"
#include "support/catch.h"
#include "support/directions.h"

using namespace vndf;
using namespace vndf::test;

namespace {

using Random = std::mt19937_64;

constexpr std::uint32_t kSign = 0x80000000;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::size_t below(std::size_t n, Random& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

/// Kinds of tables that take different ways through the kernel and the check: plain ones; with a
/// rim, and 21 segments of a curve; with rows of y, columns by the root of u, a rim and 22
/// segments; with rows, columns by u, 2 segments and the surface of a map.
const std::vector<KernelTables>& honest() {
  static const std::vector<KernelTables> all = [] {
    std::vector<KernelTables> made;
    for (const char* distribution : {"ggx", "disk", "annulus:inner=0.5", "volcano"})
      made.push_back(bake(*small_tables(distribution).tables, {.tolerance = kMostTolerance}));
    const SurfaceSlopes surface{{0.3, 0.1}, 0.5, {0.25, -1}};
    made.back() = made.back().with_text({"of a map", {.specification = {}, .surface = surface}});
    return made;
  }();
  return all;
}

/// Words at the edge of something: of whole numbers, of floats, of the block, of what was there.
std::vector<std::uint32_t> edges(std::uint32_t before, std::size_t size) {
  const auto end = static_cast<std::uint32_t>(size);
  std::vector<std::uint32_t> words{0,           1,
                                   2,           7,
                                   8,           16,
                                   31,          32,
                                   64,          0x800000,
                                   0x7fffff,    0x20000000,
                                   0x20800000,  0x3fffffff,
                                   0x40000000,  0x7fffffff,
                                   0x80000000,  0xffffffff,
                                   0xfffffff0,  0xfffffff8,
                                   end,         end - 1,
                                   end - 8,     end - 16,
                                   end - 64,    end + 1,
                                   before + 1,  before - 1,
                                   before + 8,  before - 8,
                                   before + 16, before - 16,
                                   before * 2,  before ^ kSign};
  for (const float edge : {1e-45f, 1e-38f, 1e-20f, 1e-7f, 0.25f, 0.5f, 1.0f, 2.0f, 1e7f, 1e20f,
                           3.4e38f, kInfinity, std::numeric_limits<float>::quiet_NaN()})
    for (const float sign : {1.0f, -1.0f})
      words.push_back(std::bit_cast<std::uint32_t>(sign * edge));
  return words;
}

std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t word;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

void set_word(Block& block, std::size_t at, std::uint32_t word) {
  std::memcpy(block.data() + at, &word, sizeof word);
}

/// Where words of the block are that sampling follows: those of the header up to the certificate,
/// of the first, middle and last entries of guides, and of the first and last segments of curves.
std::vector<std::size_t> followed_words(const KernelTables& tables) {
  const KernelHeader& h = tables.header();
  std::vector<std::size_t> places;
  const auto add = [&](std::size_t first, std::size_t bytes) {
    for (std::size_t at = first; at < first + bytes; at += 4) places.push_back(at);
  };
  add(0, offsetof(KernelHeader, tolerance));
  const auto add_guide = [&](std::size_t guide, std::size_t count) {
    for (const std::size_t k : {std::size_t{0}, count / 2, count - 1}) add(guide + 8 * k, 8);
  };
  for (const KernelAxis& axis :
       {h.direction, h.marginal, h.conditional, h.below_direction, h.below_marginal})
    add_guide(axis.guide, axis.count);
  if (h.separable == 0) {
    add_guide(h.slope.guide, std::size_t{2} * h.slope.count);
    add_guide(h.below_conditional.guide, h.below_conditional.count);
    add_guide(h.below_slope.guide, h.below_slope.count);
  }
  for (const kernel::VndfCurve& curve : {h.ndf, h.backfacing})
    for (const std::uint32_t k : {0u, curve.count - 1}) {
      const std::size_t at = curve.segments + k * sizeof(KernelSegment);
      add(at, sizeof(KernelSegment));
      KernelSegment segment;
      std::memcpy(&segment, tables.bytes().data() + at, sizeof segment);
      add_guide(segment.guide + (segment.first_key << 3), segment.count);
    }
  return places;
}

// Ways to change a block at random.

void flip_bit(Block& block, Random& random) {
  block.data()[below(block.size(), random)] ^= static_cast<std::byte>(1 << below(8, random));
}

/// An edge in place of any word.
void set_edge(Block& block, std::size_t at, Random& random) {
  const auto words = edges(word_at(block.bytes(), at), block.size());
  set_word(block, at, words[below(words.size(), random)]);
}
void set_any_edge(Block& block, Random& random) {
  set_edge(block, 4 * below(block.size() / 4, random), random);
}
void set_edge_of_header(Block& block, Random& random) {
  set_edge(block, 4 * below(sizeof(KernelHeader) / 4, random), random);
}

/// Up to 64 words in a row of any bits.
void scramble(Block& block, Random& random) {
  const std::size_t words = block.size() / 4, first = below(words, random);
  const std::size_t end = std::min(words, first + 1 + below(64, random));
  for (std::size_t k = first; k < end; ++k)
    set_word(block, 4 * k, static_cast<std::uint32_t>(random()));
}

/// A piece of the block at another place of it, as both may begin.
void copy_piece(Block& block, Random& random) {
  const std::size_t cubics = block.size() / 16, size = std::min<std::size_t>(cubics, 16);
  const std::size_t from = below(cubics - size + 1, random), to = below(cubics - size + 1, random);
  std::memmove(block.data() + 16 * to, block.data() + 16 * from, 16 * (1 + below(size, random)));
}

/// The first `size` bytes, a multiple of 8, with a header that says so.
Block cut(Block& whole, std::size_t size) {
  Block block(whole.bytes().first(size));
  if (size < sizeof(KernelHeader)) return block;
  KernelHeader& h = block.header();
  h.bytes = size;
  h.samples = h.text = static_cast<std::uint32_t>(size);
  h.sample_count = h.text_bytes = 0;
  return block;
}

/// What the kernel of a block promises, whatever its coefficients are (kernel_block.h).
class Judge {
 public:
  /// Samples and evaluates at random and hard inputs. Returns a promise that was broken, if any.
  std::string use(const Kernel& kernel, Random& random) {
    broken_.clear();
    for (int k = 0; k < 12; ++k) {
      const Vec3<float> wi = direction(random), other = direction(random);
      const Alpha<float> alpha{roughness(random), roughness(random)};
      const float u1 = uniform(random), u2 = uniform(random);
      const Vec3<float> wm = kernel.sample(wi, alpha, u1, u2);
      const SampledNormal<float> drawn = kernel.sample_with_density(wi, alpha, u1, u2);
      see(finite_unit(wm) && finite_unit(drawn.wm), "a normal is finite and of unit length");
      see(drawn.pdf >= 0 && std::isfinite(drawn.pdf), "a sampled density is finite and >= 0");
      for (const float value :
           {kernel.d(other, alpha), kernel.lambda(wi, alpha), kernel.g1(other, alpha),
            kernel.pdf(wi, other, alpha), kernel.pdf(wi, wm, alpha)})
        see(!(value < 0), "no function is negative");
      if (k % 4 == 0) see_inverse(kernel.invert(wi, k == 0 ? wm : other, alpha));
    }
    return broken_;
  }

 private:
  void see(bool holds, const char* promise) {
    if (!holds) broken_ = promise;
  }
  void see_inverse(const std::optional<Vec2<float>>& u) {
    see(!u || (u->x > 0 && u->x < 1 && u->y > 0 && u->y < 1), "an inverse is inside (0, 1)");
  }

  static float uniform(Random& random) {
    constexpr float kHard[] = {0,           1, 1e-7f, 0.5f,
                               0.99999994f, 2, -1,    std::numeric_limits<float>::quiet_NaN()};
    const std::size_t k = below(2 * std::size(kHard), random);
    return k < std::size(kHard) ? kHard[k] : std::uniform_real_distribution<float>(0, 1)(random);
  }
  /// From 1e-4 to 10.
  static float roughness(Random& random) {
    return std::exp(std::uniform_real_distribution<float>(-9.2f, 2.3f)(random));
  }
  static Vec3<float> direction(Random& random) {
    constexpr double kHard[] = {0, 1e-30, 1e-6, 89.9999, 90, 90.0001, 179.999, 180};
    const std::size_t k = below(2 * std::size(kHard), random);
    const double theta =
        k < std::size(kHard) ? kHard[k] : std::uniform_real_distribution<double>(0, 180)(random);
    return direction_at<float>(theta, std::uniform_real_distribution<double>(0, 360)(random));
  }

  std::string broken_;
};

/// Gives hostile blocks to the check, and those that it accepts to the judge.
class Trial {
 public:
  explicit Trial(std::uint64_t seed) : random_(seed) {}

  void give(Block& block) {
    if (block.size() >= sizeof(KernelHeader)) block.set_checksum();
    ++given_;
    try {
      const KernelTables tables = KernelTables::view(block.bytes());
      (void)tables.text();
      (void)tables.certificate();
      ++accepted_;
      const std::string broken = judge_.use(tables.kernel(), random_);
      if (!broken.empty()) ++broken_[broken];
    } catch (const KernelTablesError&) {
    }
  }

  /// Requires that no promise was broken, and that neither the check nor the judge was idle.
  void finish() const {
    CAPTURE(given_, accepted_, broken_);
    CHECK(broken_.empty());
    CHECK(accepted_ > given_ / 10);
    CHECK(given_ - accepted_ > given_ / 10);
    if (std::getenv("VNDF_TEST_REPORT") != nullptr)
      WARN(given_ << " hostile blocks, " << accepted_ << " accepted");
  }

  Random& random() { return random_; }

 private:
  Random random_;
  Judge judge_;
  std::size_t given_ = 0, accepted_ = 0;
  std::map<std::string, std::size_t> broken_;
};

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* given = std::getenv(name);
  return given != nullptr ? std::strtoull(given, nullptr, 10) : otherwise;
}

/// Places in a block for the rules below.
std::uint32_t beyond(const Block& block) {
  return static_cast<std::uint32_t>(block.size() / 16 * 16);
}
std::size_t segment_at(Block& block, std::uint32_t k) {
  return block.header().backfacing.segments + k * sizeof(KernelSegment);
}
template <class Change>
void change_segment(Block& block, std::uint32_t k, Change change) {
  KernelSegment segment;
  std::memcpy(&segment, block.data() + segment_at(block, k), sizeof segment);
  change(segment);
  std::memcpy(block.data() + segment_at(block, k), &segment, sizeof segment);
}
std::uint32_t guide_of_segment(Block& block) {
  std::uint32_t guide = 0;
  change_segment(block, 0, [&](const KernelSegment& s) { guide = s.guide + (s.first_key << 3); });
  return guide;
}

/// What breaks one rule and no rule before it.
struct Breach {
  std::size_t block;  ///< of honest()
  const char* rule;
  void (*change)(Block& block, KernelHeader& h);
};

constexpr const char* kCover = "a guide does not cover its axis";
constexpr const char* kOutside = "coefficients are outside the block";
constexpr const char* kEnd = "the samples and texts are not the end of the block";
constexpr const char* kUnit = "the unit of slopes is not a moderate number";
constexpr const char* kScale = "the scale of slope y is not a finite number > 0";
constexpr const char* kRoot = "the bounds of the root of sigma are not inside (0, 1)";
constexpr const char* kOffset = "the offset of an axis is not inside (0, 1)";
constexpr const char* kChoice = "a choice that is neither 0 nor 1";
constexpr const char* kColumns = "the offset of the columns is not inside (0, 1)";
constexpr const char* kApart = "the halves of an axis are not a power of two apart";
constexpr const char* kMiddle = "the middle of the columns is not between their ends";
constexpr const char* kSlope = "the middle of the slopes is not in (0, 1)";
constexpr const char* kLength = "the axis of slopes has no length";
constexpr const char* kSegments = "a curve has no segments";
constexpr const char* kSegment = "a segment of a curve has no length";
constexpr const char* kBelow = "the axis of directions below the horizon has no length";
constexpr const char* kShifts = "the columns of the tables differ in shift";
constexpr const char* kSteep = "the axis of rows of y has no length";
constexpr const char* kEntry = "an entry of a guide is no place or not aligned";

// Blocks by their place in honest().
constexpr std::size_t kPlain = 0, kRim = 1, kRoots = 2, kRows = 3;

/// Each condition of each rule of check_block() that bytes of a moderate number can break.
const Breach kBreaches[] = {
    {kPlain, "a header of another size", [](Block&, auto& h) { h.header_bytes += 16; }},
    {kPlain, "more bytes for sampling than there are",
     [](Block&, auto& h) { h.sampling_bytes = h.bytes + 1; }},
    {kPlain, "more bytes for sampling than there are",
     [](Block&, auto& h) { h.below_bytes = h.bytes; }},
    {kPlain, kEnd,
     [](Block& block, auto& h) {
       h.samples = h.text = sizeof(KernelHeader) - 8;
       h.text_bytes = static_cast<std::uint32_t>(block.size() - h.text);
     }},
    {kPlain, kEnd,
     [](Block&, auto& h) {
       h.samples = h.text += 1;
       h.text_bytes -= 1;
     }},
    {kPlain, kEnd,
     [](Block&, auto& h) {
       h.text += 1;
       h.text_bytes -= 1;
     }},
    {kPlain, kUnit, [](Block&, auto& h) { h.unit = 0x1p-81f; }},
    {kPlain, kUnit, [](Block&, auto& h) { h.unit = 0x1p81f; }},
    {kPlain, kScale, [](Block&, auto& h) { h.scale_root = -1, h.scale_constant = 3; }},
    {kPlain, kScale, [](Block&, auto& h) { h.scale_constant = -1, h.scale_root = 3; }},
    {kPlain, kScale, [](Block&, auto& h) { h.rim = -1, h.scale_root = 3; }},
    {kPlain, kScale, [](Block&, auto& h) { h.scale_root = kInfinity; }},
    {kPlain, kScale, [](Block&, auto& h) { h.scale_root = h.scale_constant = 0; }},
    {kPlain, kRoot, [](Block&, auto& h) { h.least_root = 0; }},
    {kPlain, kRoot, [](Block&, auto& h) { h.least_root = h.most_root; }},
    {kPlain, kRoot, [](Block&, auto& h) { h.most_root = 1; }},
    {kPlain, kOffset, [](Block&, auto& h) { h.direction_offset = 0; }},
    {kPlain, kOffset, [](Block&, auto& h) { h.direction_offset = 1; }},
    {kPlain, kChoice, [](Block&, auto& h) { h.column_roots = 2; }},
    {kPlain, kChoice, [](Block&, auto& h) { h.separable = 2; }},
    {kRoots, kColumns, [](Block&, auto& h) { h.column_offset = 0; }},
    {kRoots, kColumns, [](Block&, auto& h) { h.column_offset = 1; }},
    {kPlain, kApart, [](Block&, auto& h) { h.column_upper += 1; }},
    {kPlain, kApart, [](Block&, auto& h) { h.column_upper = kSign; }},
    {kPlain, kApart, [](Block&, auto& h) { h.column_upper = kSign + 0x20800000; }},
    {kPlain, "an axis is shifted", [](Block&, auto& h) { h.direction.shift = 32; }},
    {kPlain, "a guide is not aligned", [](Block&, auto& h) { h.direction.guide += 4; }},
    {kPlain, kOutside, [](Block& block, auto& h) { h.direction.guide = beyond(block); }},
    {kPlain, kCover, [](Block&, auto& h) { h.direction.count = 0x40000001; }},
    {kPlain, kCover, [](Block&, auto& h) { h.direction.first_key += 1; }},
    {kPlain, kCover, [](Block&, auto& h) { h.direction.count = 1; }},
    {kPlain, kCover, [](Block&, auto& h) { h.marginal.first_key += 1, h.marginal.guide += 8; }},
    {kPlain, kCover, [](Block&, auto& h) { h.marginal.count -= 1; }},
    {kPlain, kCover, [](Block&, auto& h) { h.conditional.count = 1; }},
    {kPlain, "the columns of the tables differ in shift",
     [](Block&, auto& h) { h.conditional.shift += 1, h.conditional.first_key /= 2; }},
    {kPlain, kOutside,
     [](Block& block, auto& h) { set_word(block, h.marginal.guide + 4, beyond(block)); }},
    {kPlain, kOutside,
     [](Block& block, auto& h) { set_word(block, h.direction.guide + 4, beyond(block)); }},
    {kPlain, kOutside,
     [](Block& block, auto& h) { set_word(block, h.conditional.guide + 4, beyond(block)); }},
    {kPlain, kEntry, [](Block& block, auto& h) { set_word(block, h.marginal.guide + 4, 8); }},
    {kPlain, kEntry, [](Block& block, auto& h) { set_word(block, h.marginal.guide, 0x7f800000); }},
    {kRows, kMiddle, [](Block&, auto& h) { h.column_span = 1e-30f; }},
    {kRows, kMiddle, [](Block&, auto& h) { h.column_span = 4; }},
    {kRows, "the mirror of a column is before the first",
     [](Block&, auto& h) { h.column_span = 0.5f; }},
    {kRows, kApart, [](Block&, auto& h) { h.column_mirror = 0; }},
    {kRows, kCover, [](Block&, auto& h) { h.conditional.count -= 1; }},
    {kRows, kSlope, [](Block&, auto& h) { h.slope_middle = 0; }},
    {kRows, kSlope, [](Block&, auto& h) { h.slope_middle = 1; }},
    {kRows, kLength, [](Block&, auto& h) { h.slope_offset = 0; }},
    {kRows, kLength, [](Block&, auto& h) { h.slope_offset = h.slope_most; }},
    {kRows, kLength, [](Block&, auto& h) { h.slope_most = 1; }},
    {kRows, kApart, [](Block&, auto& h) { h.slope_upper = 0; }},
    {kRows, kCover, [](Block&, auto& h) { h.slope.count = 0x8000000; }},
    {kRows, kCover, [](Block&, auto& h) { h.slope.count -= 1; }},
    {kRows, kOutside,
     [](Block& block, auto& h) { h.slope.guide = beyond(block) - 8 * h.slope.count; }},
    {kRows, kOutside,
     [](Block& block, auto& h) { set_word(block, h.slope.guide + 4, beyond(block)); }},
    {kRows, kOutside,
     [](Block& block, auto& h) { set_word(block, h.slope.guide + 12, beyond(block)); }},
    {kPlain, "directions below the horizon have no patches",
     [](Block&, auto& h) { h.below_bytes = 0; }},
    {kPlain, kBelow, [](Block&, auto& h) { h.below_most_cotangent = 0; }},
    {kPlain, kBelow, [](Block&, auto& h) { h.below_least_place = 0; }},
    {kPlain, kBelow, [](Block&, auto& h) { h.below_least_place = 1 + h.direction_offset; }},
    {kPlain, kCover, [](Block&, auto& h) { h.below_direction.count -= 1; }},
    {kPlain, kShifts, [](Block&, auto& h) { h.below_marginal.shift += 1; }},
    {kPlain, kCover, [](Block&, auto& h) { h.below_marginal.count -= 1; }},
    {kPlain, kOutside,
     [](Block& block, auto& h) { set_word(block, h.below_marginal.guide + 4, beyond(block)); }},
    {kPlain, kOutside,
     [](Block& block, auto& h) { set_word(block, h.below_direction.guide + 4, beyond(block)); }},
    {kRows, kShifts, [](Block&, auto& h) { h.below_conditional.shift += 1; }},
    {kRows, kCover, [](Block&, auto& h) { h.below_conditional.count -= 1; }},
    {kRows, kSteep, [](Block&, auto& h) { h.below_slope_most = h.slope_offset / 2; }},
    {kRows, kSteep, [](Block&, auto& h) { h.below_slope_most = 1; }},
    {kRows, kCover, [](Block&, auto& h) { h.below_slope.count -= 1; }},
    {kRows, kOutside,
     [](Block& block, auto& h) { set_word(block, h.below_conditional.guide + 4, beyond(block)); }},
    {kRows, kOutside,
     [](Block& block, auto& h) { set_word(block, h.below_slope.guide + 4, beyond(block)); }},
    {kRim, kSegments, [](Block&, auto& h) { h.backfacing.count = 0; }},
    {kRim, kSegments, [](Block&, auto& h) { h.backfacing.count = 4097; }},
    {kRim, kSegments, [](Block&, auto& h) { h.backfacing.segments += 8; }},
    {kRim, kOutside, [](Block& block, auto& h) { h.backfacing.segments = beyond(block); }},
    {kRim, kSegment,
     [](Block& block, auto&) { change_segment(block, 0, [](auto& s) { s.begin = -1; }); }},
    {kRim, kSegment,
     [](Block& block, auto&) { change_segment(block, 1, [](auto& s) { s.begin = 0; }); }},
    {kRim, kSegment,
     [](Block& block, auto&) { change_segment(block, 0, [](auto& s) { s.end = s.begin; }); }},
    {kRim, kSegment,
     [](Block& block,
        auto&
            h) { change_segment(block, h.backfacing.count - 1, [](auto& s) { s.end = kInfinity; }); }},
    {kRim, kSegment,
     [](Block& block, auto&) { change_segment(block, 0, [](auto& s) { s.offset = 0; }); }},
    {kRim, kSegment,
     [](Block& block, auto&) { change_segment(block, 0, [](auto& s) { s.offset = 1; }); }},
    {kRim, kCover,
     [](Block& block, auto&) { change_segment(block, 0, [](auto& s) { s.count -= 1; }); }},
    {kRim, kOutside,
     [](Block& block, auto&) { set_word(block, guide_of_segment(block) + 4, beyond(block)); }},
};

}  // namespace

TEST_CASE("each rule of a block refuses what breaks it") {
  for (const Breach& breach : kBreaches) {
    CAPTURE(&breach - kBreaches);
    Block block(honest()[breach.block].bytes());
    breach.change(block, block.header());
    block.set_checksum();
    CHECK_THROWS_WITH(KernelTables::view(block.bytes()), contains(breach.rule));
  }
}

TEST_CASE("a block that is longer than any is refused, and so is one with too many samples") {
  const std::span<const std::byte> bytes = honest().front().bytes();
  // Memory that takes room only where it is written.
  constexpr std::size_t kSize = kKernelMostBytes + 64;
  void* memory = mmap(nullptr, kSize, PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  std::memcpy(memory, bytes.data(), sizeof(KernelHeader));
  static_cast<KernelHeader*>(memory)->bytes = kSize;
  CHECK_THROWS_WITH(KernelTables::view({static_cast<const std::byte*>(memory), kSize}),
                    contains("the bytes are fewer or more"));
  munmap(memory, kSize);

  std::vector<std::byte> longer(bytes.begin(), bytes.end());
  longer.resize(longer.size() / 8 * 8 + (kMaxSamples + 1) * kKernelSampleBytes);
  Block block(longer);
  KernelHeader& h = block.header();
  h.bytes = h.text = static_cast<std::uint32_t>(block.size());
  h.sample_count = kMaxSamples + 1;
  h.samples = h.text - h.sample_count * std::uint32_t{kKernelSampleBytes};
  h.text_bytes = 0;
  block.set_checksum();
  CHECK_THROWS_WITH(KernelTables::view(block.bytes()), contains(kEnd));
}

TEST_CASE("a block with an extreme number in any field or entry is refused or samples in bounds") {
  Trial trial(1);
  for (const KernelTables& tables : honest()) {
    Block block(tables.bytes());
    for (const std::size_t at : followed_words(tables)) {
      const std::uint32_t before = word_at(block.bytes(), at);
      for (const std::uint32_t word : edges(before, block.size())) {
        set_word(block, at, word);
        trial.give(block);
      }
      set_word(block, at, before);
    }
  }
  trial.finish();
}

TEST_CASE("random mutants of blocks are refused or sample in bounds") {
  constexpr std::uint64_t kMutants = 65'000;
  constexpr void (*kChanges[])(Block&, Random&) = {flip_bit, set_any_edge, set_edge_of_header,
                                                   scramble, copy_piece};
  Trial trial(from_environment("VNDF_TEST_SEED", 1));
  Random& random = trial.random();
  std::vector<Block> blocks;
  for (const KernelTables& tables : honest()) blocks.emplace_back(tables.bytes());
  const std::uint64_t mutants = from_environment("VNDF_TEST_MUTANTS", kMutants);
  for (std::uint64_t k = 0; k < mutants; ++k) {
    const std::size_t which = below(blocks.size(), random);
    Block& block = blocks[which];
    for (std::size_t change = 0; change <= below(4, random); ++change)
      kChanges[below(std::size(kChanges), random)](block, random);
    if (below(16, random) == 0) {
      Block shorter = cut(block, 8 * below(block.size() / 8, random));
      trial.give(shorter);
    } else {
      trial.give(block);
    }
    std::memcpy(block.data(), honest()[which].bytes().data(), block.size());
  }
  trial.finish();
}

TEST_CASE("random bytes are no block, with the first words of one or not") {
  constexpr std::size_t kMostSize = 4096, kStrings = 5000;
  Random random(1);
  for (std::size_t k = 0; k < kStrings; ++k) {
    std::vector<std::byte> bytes(8 * below(kMostSize / 8, random));
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    Block block(bytes);
    if (k % 2 == 0 && block.size() >= sizeof(KernelHeader)) {
      std::memcpy(block.data(), honest().front().bytes().data(), offsetof(KernelHeader, bytes));
      block = cut(block, block.size());
      block.set_checksum();
    }
    CHECK_THROWS_AS(KernelTables::view(block.bytes()), KernelTablesError);
  }
}
