#include "conversion/depth_png.hpp"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <vector>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

constexpr png_uint_32 kMaxSide = 8192;

/// What libpng's callbacks and jumps work on: it outlives them all, so no destructor is jumped
/// over.
struct Decoder {
  std::string_view rest;
  std::string error;
  png_structp png = nullptr;
  png_infop info = nullptr;
  DepthPng image;
  std::vector<png_bytep> rows;

  ~Decoder() { png_destroy_read_struct(&png, &info, nullptr); }
};

void onError(png_structp png, png_const_charp message) {
  static_cast<Decoder*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep bytes, png_size_t size) {
  auto& rest = static_cast<Decoder*>(png_get_io_ptr(png))->rest;
  if (rest.size() < size) png_error(png, "the file ends early");
  std::memcpy(bytes, rest.data(), size);
  rest.remove_prefix(size);
}

/// Reads the header; false with an error, by way of a jump that ends in this function.
bool readHeader(Decoder& decoder) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_read_info(decoder.png, decoder.info);
  if (png_get_bit_depth(decoder.png, decoder.info) != 16 ||
      png_get_color_type(decoder.png, decoder.info) != PNG_COLOR_TYPE_GRAY) {
    png_error(decoder.png, "found another kind of PNG, expected 16 bits of grey");
  }
  png_set_interlace_handling(decoder.png);
  png_read_update_info(decoder.png, decoder.info);
  return true;
}

bool readRows(Decoder& decoder) {
  if (setjmp(png_jmpbuf(decoder.png)) != 0) return false;
  png_read_image(decoder.png, decoder.rows.data());
  png_read_end(decoder.png, nullptr);
  return true;
}

void prepareRows(Decoder& decoder) {
  DepthPng& image = decoder.image;
  image.width = png_get_image_width(decoder.png, decoder.info);
  image.height = png_get_image_height(decoder.png, decoder.info);
  image.pixels.resize(std::size_t{2} * image.width * image.height);
  for (std::size_t row = 0; row != image.height; ++row) {
    decoder.rows.push_back(reinterpret_cast<png_bytep>(image.pixels.data()) +
                           row * 2 * image.width);
  }
}

}  // namespace

pcrb::DepthImage DepthPng::view(double units_per_metre) const {
  pcrb::DepthImage image;
  image.width = width;
  image.height = height;
  image.row_bytes = std::size_t{2} * width;
  image.format = pcrb::DepthFormat::kUnsigned16;
  image.big_endian = true;
  image.units_per_metre = units_per_metre;
  image.bytes = pixels;
  return image;
}

DepthPng decodeDepthPng(std::string_view bytes, const std::string& name) {
  Decoder decoder;
  decoder.rest = bytes;
  decoder.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoder, onError, onWarning);
  if (decoder.png != nullptr) decoder.info = png_create_info_struct(decoder.png);
  if (decoder.info == nullptr) throw std::bad_alloc();
  png_set_read_fn(decoder.png, &decoder, onRead);
  png_set_user_limits(decoder.png, kMaxSide, kMaxSide);
  bool good = readHeader(decoder);
  if (good) {
    prepareRows(decoder);
    good = readRows(decoder);
  }
  if (!good) throw pcrb::InvalidFile(name, "no depth image: " + decoder.error);
  return std::move(decoder.image);
}

}  // namespace pcrb_tools
