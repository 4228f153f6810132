#include "common/process.hpp"

#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "pcrb_core/error.hpp"

namespace pcrb_tools {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void onSignal(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  interrupted = 0;
}

void Interruption::check() {
  if (interrupted != 0) throw Interrupted();
}

int runChild(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawn(&child, argv[0], nullptr, nullptr, argv.data(), environ);
  if (error != 0) {
    throw pcrb::InvalidFile(command[0], "cannot be run: " + std::generic_category().message(error));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      throw pcrb::Error(command[0] + ": lost: " + std::generic_category().message(errno));
    }
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

namespace fs = std::filesystem;

namespace {

fs::path folderForTemporaryFiles() {
  std::error_code error;
  const fs::path folder = fs::temp_directory_path(error);
  if (!error) return folder;
  const char* const variable = std::getenv("TMPDIR");
  throw pcrb::InvalidParameter("TMPDIR: found `" +
                               std::string(variable == nullptr ? "" : variable) +
                               "`, expected a folder that exists");
}

}  // namespace

TemporaryFolder::TemporaryFolder(const std::string& name)
    : path_((folderForTemporaryFiles() / (name + "_XXXXXX")).string()) {
  if (mkdtemp(path_.data()) == nullptr) {
    throw pcrb::InvalidFile(path_, std::string("cannot be made: ") + std::strerror(errno));
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace pcrb_tools
