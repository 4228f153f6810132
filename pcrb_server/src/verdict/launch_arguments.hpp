#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pcrb {

/// Names of the `name:=value` words of a command line whose file is `launch_file`; none for another
/// command line. roslaunch and rostest pass over arguments that a file does not declare, so that a
/// misspelt threshold would be none.
///
/// @param command_line  the words, each behind a zero byte but the first, as /proc has them.
std::vector<std::string> launchArguments(std::string_view command_line,
                                         std::string_view launch_file);

/// The command line of the process that started this one; empty where it is not to be read.
std::string commandLineOfParent();

}  // namespace pcrb
