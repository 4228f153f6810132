#include "ros/notices.hpp"

#include <ros/this_node.h>

#include <iostream>

namespace pcrb {

namespace {

/// With two blanks before each line but the first that has none.
std::string withIndentedLines(const std::string& text) {
  std::string indented;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_begin = i > 0 && text[i - 1] == '\n';
    if (is_begin && text[i] != ' ') indented += "  ";
    indented += text[i];
  }
  return indented;
}

}  // namespace

void tellPeople(const std::string& text) {
  const std::string& name = ros::this_node::getName();
  // In one piece, since other programs write to the same log.
  std::cout << "[" + name.substr(name.rfind('/') + 1) + "] " + withIndentedLines(text) + "\n"
            << std::flush;
}

void Notice::tell(const std::string& text) {
  if (text == told_) return;
  told_ = text;
  if (!text.empty()) tellPeople(text);
}

}  // namespace pcrb
