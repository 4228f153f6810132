#include "pcrb_core/io/process_limits.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <new>

namespace pcrb {
namespace {

std::string& programName() {
  static std::string name;
  return name;
}

/// Writes without taking memory, of which there may be none.
void writeToStandardError(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) return;  // nobody can be told
}

const char* const kOutOfMemory =
    "out of memory: more than the machine or `ulimit -v` gives (fewer threads take less)";

[[noreturn]] void sayAndEnd() {
  writeToStandardError(programName().c_str());
  writeToStandardError(": ");
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
    writeToStandardError("ended for no known reason");
  } catch (const std::bad_alloc&) {
    writeToStandardError(kOutOfMemory);
  } catch (const std::exception& error) {
    writeToStandardError(error.what());
  } catch (...) {
    writeToStandardError("an unknown exception");
  }
  writeToStandardError("\n");
  _exit(EXIT_FAILURE);
}

}  // namespace

void turnLimitsIntoErrors(const std::string& program) {
  programName() = program;
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(sayAndEnd);
}

std::string describeFailure(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return kOutOfMemory;
  return error.what();
}

}  // namespace pcrb
