/// Every kind of PNG, to the colours that the library has for the file.
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
  LodePNGColorType colour;
  int depth;
};
constexpr std::array all_kinds{
    Kind{LCT_GREY, 1},    Kind{LCT_GREY, 2},       Kind{LCT_GREY, 4},        Kind{LCT_GREY, 8},    Kind{LCT_GREY, 16},
    Kind{LCT_RGB, 8},     Kind{LCT_RGB, 16},       Kind{LCT_PALETTE, 1},     Kind{LCT_PALETTE, 2}, Kind{LCT_PALETTE, 4},
    Kind{LCT_PALETTE, 8}, Kind{LCT_GREY_ALPHA, 8}, Kind{LCT_GREY_ALPHA, 16}, Kind{LCT_RGBA, 8},    Kind{LCT_RGBA, 16},
};

PngFile random_file(const Kind& kind, bool interlaced, Random& random) {
  PngFile file{kind.colour, kind.depth, interlaced, random.integer(1, 19), random.integer(1, 19)};
  const int count = file.width * file.height * file.channels();
  for (int i = 0; i < count; ++i)
    file.samples.push_back(static_cast<std::uint16_t>(random.integer(0, (1 << file.depth) - 1)));
  const auto byte = [&] { return static_cast<std::uint8_t>(random.integer(0, 255)); };
  for (int i = 0; kind.colour == LCT_PALETTE && i < 1 << kind.depth; ++i)
    file.palette.push_back({byte(), byte(), byte(), i < 3 ? byte() : std::uint8_t{255}});
  if ((kind.colour == LCT_GREY || kind.colour == LCT_RGB) && random.chance(0.5))
    for (int channel = 0; channel < file.channels(); ++channel) file.transparent.push_back(file.sample(0, 0, channel));
  return file;
}

TEST_F(PngFiles, of_every_kind_are_read_as_what_is_in_them) {
  constexpr std::uint64_t seed = 31;
  Random random(seed);
  for (const Kind& kind : all_kinds) {
    for (int i = 0; i < 12; ++i) {
      const PngFile file = random_file(kind, i % 2 == 1, random);
      const std::string bytes = file.bytes();
      const PngPicture picture = read_png(files.write("a.png", bytes), "a.png");
      EXPECT_EQ(picture.palette, file.palette);
      std::vector<unsigned char> rgba;
      unsigned width = 0;
      unsigned height = 0;
      const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
      ASSERT_EQ(lodepng::decode(rgba, width, height, begin, bytes.size()), 0U);
      std::vector<unsigned char> read;
      for (int row = 0; row < picture.height; ++row)
        for (int column = 0; column < picture.width; ++column)
          for (const std::uint8_t part : picture.colour_at(column, row)) read.push_back(part);
      ASSERT_EQ(read, rgba) << "seed " << seed << ", colour type " << int(kind.colour) << ", " << kind.depth
                            << " bits, file " << i;
      ASSERT_EQ(picture.width, static_cast<int>(width));
    }
  }
}

std::string complaint_about(const SceneFiles& files, const std::string& bytes) {
  return test::refusal_by<InputError>([&] { (void)read_png(files.write("a.png", bytes), "a.png"); }, "accepted");
}

TEST_F(PngFiles, with_an_index_beyond_their_palette_are_refused) {
  PngFile file{LCT_PALETTE, 2, false, 3, 1, {0, 1, 1}, {{1, 2, 3, 255}, {4, 5, 6, 255}}};
  EXPECT_EQ(complaint_about(files, file.bytes()), "accepted");
  file.samples = {0, 1, 3};
  EXPECT_EQ(complaint_about(files, file.bytes()),
            "a.png: expected a PNG picture (a pixel has index 3, and its palette 2 colours)");
  std::string without = file.bytes();
  without.erase(without.find("PLTE") - 4, 4 + 4 + 6 + 4);  // its length, name, colours and checksum
  EXPECT_TRUE(begins(complaint_about(files, without), "a.png: expected a PNG picture ("));
}

TEST_F(PngFiles, that_unpack_to_more_than_their_size_are_refused_on_the_way) {
  const std::string large = PngFile{LCT_GREY, 8, false, 300, 300, std::vector<std::uint16_t>(90'000)}.bytes();
  const std::string one_pixel = big_endian(1) + big_endian(1) + large.substr(24, 5);
  EXPECT_EQ(complaint_about(files, large.substr(0, 8) + png_chunk("IHDR", one_pixel) + large.substr(33)),
            "a.png: expected a PNG picture (tried to decompress zlib or deflate data larger than desired "
            "max_output_size)");
}

TEST_F(PngFiles, cut_off_anywhere_or_with_a_spoilt_byte_are_refused_or_read) {
  const std::string whole = PngFile{LCT_GREY, 16, true, 3, 2, {0, 1, 2, 3, 4, 65535}}.bytes();
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
