#include "conversion/pose_text.hpp"

#include "pcrb_core/io/number.hpp"

namespace pcrb_tools {

std::string poseText(const pcrb::Transform& pose) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      text += ' ';
      pcrb::appendShortest(text, pose.matrix()(row, column));
    }
  }
  return text;
}

}  // namespace pcrb_tools
