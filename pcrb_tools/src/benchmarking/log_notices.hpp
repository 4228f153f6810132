#pragma once

#include <cstddef>
#include <ios>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pcrb_tools {

/// What the log of a roslaunch tells people who watch a run, as it is written: lines that nodes of
/// the suite tell people (`[NODE] text`, further lines indented), and errors that other nodes print
/// before they have answered, the first few of them.
class LogNotices {
 public:
  /// @param start  byte of the log at which to begin.
  LogNotices(std::string path, std::streamoff start);

  /// What has come since the call before. Of each node of the suite a text that only repeats what
  /// it told last is left out.
  /// @param with_errors  whether errors of other nodes are of interest.
  std::vector<std::string> next(bool with_errors);

  /// What a node of the suite told last; empty if it told nothing.
  std::string last(const std::string& node) const;

 private:
  void take(const std::string& line, bool with_errors, std::vector<std::string>& texts);
  void finishNotice(std::vector<std::string>& texts);
  void takeError(const std::string& text, std::vector<std::string>& texts);

  std::string path_;
  std::streamoff place_;
  std::string unfinished_;  ///< a line whose end has not been written
  std::string speaker_;     ///< of the text that is being read; empty: none
  std::string text_;
  std::map<std::string, std::string> told_;  ///< last text of each node of the suite
  std::set<std::string> errors_;
  bool is_traceback_ = false;
};

/// Text of a line of a log if it is an error that a node under test, or roslaunch for it, prints:
/// without colours, times and the command line of a process; empty otherwise.
std::string errorOfNode(const std::string& line);

}  // namespace pcrb_tools
