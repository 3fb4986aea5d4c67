#include "scenes/png_file.hpp"

#include "scenes/input_error.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <string_view>

namespace paperproof::compare {
namespace {

/// 256 MiB once it is unpacked.
constexpr std::uint64_t max_pixels = std::uint64_t{1} << 26;
constexpr std::size_t bytes_per_colour = 4;

/// What libpng reads from, and what it said last.
struct Source {
  std::string_view bytes;
  std::size_t at = 0;
  std::array<char, 128> complaint{};
};

[[noreturn]] void on_error(png_structp png, png_const_charp complaint) {
  auto& source = *static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source.complaint.data(), complaint, source.complaint.size() - 1);
  png_longjmp(png, 1);
}

/// It would be printed otherwise.
void on_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (count > source.bytes.size() - source.at) png_error(png, "the file ends too early");
  std::memcpy(to, source.bytes.data() + source.at, count);
  source.at += count;
}

/// Runs `work`; false where libpng left it by a long jump. Nothing with a destructor may live in `work` or below it,
/// nor here, since none would run.
template <class Work>
bool is_done(png_structp png, const Work& work) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  work();
  return true;
}

/// The classic interface of libpng: the simple one takes 16 bits for linear light and applies the file's gamma. What it
/// has allocated goes when this does.
class PngReader {
 public:
  PngReader(std::string_view bytes, const std::string& given) : source_{bytes}, given_(given) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, on_error, on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);  // without a constructed object there is no destructor
      refuse(given_, "expected memory for a PNG picture; there is none");
    }
    png_set_read_fn(png_, &source_, read_bytes);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours is on the product
  }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

  [[nodiscard]] PngPicture read() {
    attempt([this] { png_read_info(png_, info_); });
    const std::uint64_t width = png_get_image_width(png_, info_);
    const std::uint64_t height = png_get_image_height(png_, info_);
    if (width * height > max_pixels)
      refuse(given_, fmt::format("expected a picture of at most {} pixels, not {} x {}", max_pixels, width, height));
    PngPicture picture{static_cast<int>(width), static_cast<int>(height), read_palette(), {}};
    int passes = 1;
    attempt([this, &passes] { passes = ask_for_bytes(); });
    const std::size_t stride = width * (picture.palette.empty() ? bytes_per_colour : 1);
    if (png_get_rowbytes(png_, info_) != stride) refuse(given_, "expected a PNG picture of a known kind");
    picture.bytes.resize(stride * height);
    attempt([this, &picture, passes, stride] { read_rows(picture, passes, stride); });
    check_indices(picture);
    return picture;
  }

 private:
  template <class Work>
  void attempt(const Work& work) {
    if (!is_done(png_, work)) refuse(given_, fmt::format("expected a PNG picture ({})", source_.complaint.data()));
  }

  [[nodiscard]] bool is_indexed() const { return png_get_color_type(png_, info_) == PNG_COLOR_TYPE_PALETTE; }

  [[nodiscard]] std::vector<Rgba> read_palette() {
    if (!is_indexed()) return {};
    png_colorp colours = nullptr;
    int count = 0;
    png_bytep alphas = nullptr;
    int alpha_count = 0;
    attempt([&] {
      png_get_PLTE(png_, info_, &colours, &count);
      png_get_tRNS(png_, info_, &alphas, &alpha_count, nullptr);
    });
    std::vector<Rgba> palette;
    for (int i = 0; i < count; ++i)
      palette.push_back(
          {colours[i].red, colours[i].green, colours[i].blue, i < alpha_count ? alphas[i] : Rgba::value_type{255}});
    return palette;
  }

  /// One byte for an index, four for a colour. @returns how often the rows are gone through.
  int ask_for_bytes() {
    if (is_indexed()) {
      png_set_packing(png_);
    } else {
      const bool has_alpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                             png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
      png_set_expand(png_);
      png_set_scale_16(png_);
      png_set_gray_to_rgb(png_);
      if (!has_alpha) png_set_add_alpha(png_, 255, PNG_FILLER_AFTER);
    }
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return passes;
  }

  void read_rows(PngPicture& picture, int passes, std::size_t stride) {
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t row = 0; row < static_cast<std::size_t>(picture.height); ++row)
        png_read_row(png_, picture.bytes.data() + row * stride, nullptr);
    }
    png_read_end(png_, nullptr);
  }

  void check_indices(const PngPicture& picture) const {
    if (picture.palette.empty()) return;
    const std::uint8_t highest = *std::max_element(picture.bytes.begin(), picture.bytes.end());
    if (highest >= picture.palette.size())
      refuse(given_, fmt::format("expected a PNG picture (a pixel has index {}, and its palette {} colours)", highest,
                                 picture.palette.size()));
  }

  Source source_;
  const std::string& given_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

Rgba PngPicture::colour_at(int column, int row) const noexcept {
  if (!palette.empty()) return palette[index_at(column, row)];
  const std::uint8_t* at = bytes.data() + place_of(column, row) * bytes_per_colour;
  return {at[0], at[1], at[2], at[3]};
}

PngPicture read_png(const std::string& path, const std::string& given) {
  const std::string bytes = read_file(path, given);
  return PngReader(bytes, given).read();
}

}  // namespace paperproof::compare
