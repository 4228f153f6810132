#pragma once

#include <string>

/// What a node tells people while it runs.
namespace pcrb {

/// Prints `[NODE] text` on standard output, where NODE is the name of this node without its
/// namespace; further lines of the text are indented. `pcrb localize` and all else that keeps what
/// roslaunch prints in a log shows these lines on its terminal.
void tellPeople(const std::string& text);

/// Something that may last, such as what is waited for: told again only when its text changes;
/// an empty text is told to nobody.
class Notice {
 public:
  void tell(const std::string& text);

 private:
  std::string told_;
};

}  // namespace pcrb
