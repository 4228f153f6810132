#pragma once

#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcrb_test {

/// A PNG of grey pixels, with 16 bits each or, on request, 8.
inline std::string makePng(std::uint32_t width, std::uint32_t height,
                           const std::vector<std::uint16_t>& pixels, int bits = 16) {
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp writer, png_bytep data, png_size_t size) {
        static_cast<std::string*>(png_get_io_ptr(writer))
            ->append(reinterpret_cast<const char*>(data), size);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, width, height, bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  for (std::uint32_t row = 0; row != height; ++row) {
    std::vector<png_byte> line;
    for (std::uint32_t column = 0; column != width; ++column) {
      const std::uint16_t pixel = pixels.at(row * width + column);
      if (bits == 16) line.push_back(static_cast<png_byte>(pixel >> 8));
      line.push_back(static_cast<png_byte>(pixel & 0xff));
    }
    png_write_row(png, line.data());
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

}  // namespace pcrb_test
