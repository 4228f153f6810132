#pragma once

#include <string>

#include "pcrb_core/io/number.hpp"

// Pieces of SVG that the pictures of ground truth share; all coordinates in px.

namespace pcrb_tools {

inline std::string px(double value) { return pcrb::formatFixed(value, 1); }

inline std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '<' ? std::string("&lt;") : c == '&' ? std::string("&amp;") : std::string(1, c);
  }
  return result;
}

inline std::string label(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x='" + px(x) + "' y='" + px(y) + "' text-anchor='" + anchor + "'>" + escaped(text) +
         "</text>\n";
}

inline std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1='" + px(x1) + "' y1='" + px(y1) + "' x2='" + px(x2) + "' y2='" + px(y2) +
         "' class='" + style + "'/>\n";
}

/// The beginning of a picture, with its styles (CSS) and a white ground.
inline std::string beginSvg(double width, double height, const std::string& styles) {
  return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " + px(width) + " " + px(height) +
         "' width='" + px(width) + "' height='" + px(height) +
         "' font-family='sans-serif' font-size='11'>\n<style>" + styles +
         "</style>\n<rect width='100%' height='100%' fill='white'/>\n";
}

inline std::string movedGroup(double x, double y, const std::string& content) {
  return "<g transform='translate(" + px(x) + " " + px(y) + ")'>\n" + content + "</g>\n";
}

}  // namespace pcrb_tools
