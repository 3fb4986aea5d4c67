/// Every kind of PNG, to the colours that are in the file.
#include "scenes/png_file.hpp"

#include "compare/png_files.hpp"
#include "compare/scene_files.hpp"
#include "support/random_runs.hpp"
#include "support/refusal.hpp"

namespace paperproof::compare {
namespace {

using PngFiles = SceneFilesTest;

using test::Random;

struct Kind {
  PngColour colour;
  int depth;
};
constexpr std::array all_kinds{
    Kind{PngColour::grey, 1},        Kind{PngColour::grey, 2},      Kind{PngColour::grey, 4},
    Kind{PngColour::grey, 8},        Kind{PngColour::grey, 16},     Kind{PngColour::rgb, 8},
    Kind{PngColour::rgb, 16},        Kind{PngColour::indexed, 1},   Kind{PngColour::indexed, 2},
    Kind{PngColour::indexed, 4},     Kind{PngColour::indexed, 8},   Kind{PngColour::grey_alpha, 8},
    Kind{PngColour::grey_alpha, 16}, Kind{PngColour::rgb_alpha, 8}, Kind{PngColour::rgb_alpha, 16},
};

/// The same share of 255, to the nearest whole number: never half-way, since 255 and 2^depth - 1 are odd.
std::uint8_t as_byte(unsigned sample, int depth) {
  const unsigned most = (1U << depth) - 1;
  return static_cast<std::uint8_t>((2 * 255 * sample + most) / (2 * most));
}

/// A file with what its pixels have to be read as.
struct Known {
  PngFile file;
  std::vector<Rgba> palette;
  std::vector<unsigned> transparent;  ///< Of a kind without alpha: the sample, or the three, that tRNS names.

  [[nodiscard]] Rgba expected(int column, int row) const {
    const auto raw = [&](int channel) { return unsigned{file.sample(column, row, channel)}; };
    const auto byte = [&](int channel) { return as_byte(raw(channel), file.depth); };
    const auto alpha = [&](bool is_named) { return std::uint8_t(is_named ? 0 : 255); };
    switch (file.colour) {
      case PngColour::indexed:
        return palette[raw(0)];
      case PngColour::grey:
        return {byte(0), byte(0), byte(0), alpha(transparent == std::vector{raw(0)})};
      case PngColour::grey_alpha:
        return {byte(0), byte(0), byte(0), byte(1)};
      case PngColour::rgb:
        return {byte(0), byte(1), byte(2), alpha(transparent == std::vector{raw(0), raw(1), raw(2)})};
      case PngColour::rgb_alpha:
        return {byte(0), byte(1), byte(2), byte(3)};
    }
    return {};
  }
};

Known random_file(const Kind& kind, bool interlaced, Random& random) {
  Known known{{kind.colour, kind.depth, interlaced, random.integer(1, 19), random.integer(1, 19), {}, {}}, {}, {}};
  PngFile& file = known.file;
  const int count = file.width * file.height * file.channels();
  for (int i = 0; i < count; ++i)
    file.samples.push_back(static_cast<std::uint16_t>(random.integer(0, (1 << file.depth) - 1)));
  // Light in the file is not a level's business.
  const int profile = random.integer(0, 2);
  if (profile == 1) file.chunks += png_chunk("gAMA", big_endian(100'000));
  if (profile == 2) file.chunks += png_chunk("gAMA", big_endian(45'455)) + png_chunk("sRGB", std::string(1, '\0'));
  if (kind.colour == PngColour::indexed) {
    std::string colours;
    std::string alphas;
    for (int i = 0; i < 1 << kind.depth; ++i) {
      const auto byte = [&] { return static_cast<std::uint8_t>(random.integer(0, 255)); };
      known.palette.push_back({byte(), byte(), byte(), i < 3 ? byte() : std::uint8_t{255}});
      for (std::size_t channel = 0; channel < 3; ++channel) colours += static_cast<char>(known.palette.back()[channel]);
      if (i < 3) alphas += static_cast<char>(known.palette.back()[3]);
    }
    file.chunks += png_chunk("PLTE", colours) + png_chunk("tRNS", alphas);
  } else if ((kind.colour == PngColour::grey || kind.colour == PngColour::rgb) && random.chance(0.5)) {
    std::string named;
    for (int channel = 0; channel < file.channels(); ++channel) {
      known.transparent.push_back(file.sample(0, 0, channel));
      named += big_endian(known.transparent.back()).substr(2);
    }
    file.chunks += png_chunk("tRNS", named);
  }
  return known;
}

TEST_F(PngFiles, of_every_kind_are_read_as_what_is_in_them) {
  constexpr std::uint64_t seed = 31;
  Random random(seed);
  for (const Kind& kind : all_kinds) {
    for (int i = 0; i < 12; ++i) {
      const Known known = random_file(kind, i % 2 == 1, random);
      const PngPicture picture = read_png(files.write("a.png", known.file.bytes()), "a.png");
      ASSERT_EQ(picture.width, known.file.width);
      ASSERT_EQ(picture.height, known.file.height);
      EXPECT_EQ(picture.palette, known.palette);
      for (int row = 0; row < picture.height; ++row) {
        for (int column = 0; column < picture.width; ++column) {
          ASSERT_EQ(picture.colour_at(column, row), known.expected(column, row))
              << "seed " << seed << ", colour type " << int(kind.colour) << ", " << kind.depth << " bits, file " << i
              << ": " << column << ' ' << row;
        }
      }
    }
  }
}

std::string complaint_about(const SceneFiles& files, const std::string& bytes) {
  return test::refusal_by<InputError>([&] { (void)read_png(files.write("a.png", bytes), "a.png"); }, "accepted");
}

TEST_F(PngFiles, with_an_index_beyond_their_palette_are_refused) {
  PngFile file{PngColour::indexed, 2, false, 3, 1, {0, 1, 1}, png_chunk("PLTE", "abcdef")};
  EXPECT_EQ(complaint_about(files, file.bytes()), "accepted");
  file.samples = {0, 1, 3};
  EXPECT_EQ(complaint_about(files, file.bytes()),
            "a.png: expected a PNG picture (a pixel has index 3, and its palette 2 colours)");
  file.chunks.clear();
  EXPECT_TRUE(begins(complaint_about(files, file.bytes()), "a.png: expected a PNG picture ("));
}

TEST_F(PngFiles, that_unpack_to_more_than_their_size_are_refused_on_the_way) {
  const std::string large = PngFile{PngColour::grey, 8, false, 300, 300, std::vector<std::uint16_t>(90'000)}.bytes();
  const std::string one_pixel = big_endian(1) + big_endian(1) + large.substr(24, 5);
  EXPECT_EQ(complaint_about(files, large.substr(0, 8) + png_chunk("IHDR", one_pixel) + large.substr(33)),
            "a.png: expected a PNG picture (tried to decompress zlib or deflate data larger than desired "
            "max_output_size)");
}

TEST_F(PngFiles, cut_off_anywhere_or_with_a_spoilt_byte_are_refused_or_read) {
  const std::string whole = PngFile{PngColour::grey, 16, true, 3, 2, {0, 1, 2, 3, 4, 65535}}.bytes();
  for (std::size_t length = 0; length < whole.size(); ++length)
    ASSERT_TRUE(begins(complaint_about(files, whole.substr(0, length)), "a.png: expected a PNG picture (")) << length;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string spoilt = whole;
    spoilt[at] = static_cast<char>(spoilt[at] ^ 0x10);
    const std::string said = complaint_about(files, spoilt);  // a spoilt chunk that is not needed is passed over
    ASSERT_TRUE(said == "accepted" || begins(said, "a.png: expected a ")) << said;
  }
}

}  // namespace
}  // namespace paperproof::compare
