#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace pcrb_test {

/// The servers of file_servers.py for the time that the object lives.
class FileServers {
 public:
  explicit FileServers(const std::string& folder) {
    setenv("no_proxy", "127.0.0.1", 1);
    const std::string script = PCRB_TOOLS_FOLDER "/test/support/file_servers.py";
    std::array<int, 2> to_child{};
    std::array<int, 2> from_child{};
    if (pipe2(to_child.data(), O_CLOEXEC) != 0 || pipe2(from_child.data(), O_CLOEXEC) != 0) {
      throw std::runtime_error("pipe failed");
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, to_child[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, from_child[1], STDOUT_FILENO);
    std::array<std::string, 3> words{PCRB_PYTHON, script, folder};
    std::array<char*, 4> argv{words[0].data(), words[1].data(), words[2].data(), nullptr};
    const int error = posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(to_child[0]);
    close(from_child[1]);
    to_child_ = to_child[1];
    if (error != 0) throw std::runtime_error("cannot run " + script);
    std::FILE* ports = fdopen(from_child[0], "r");
    if (std::fscanf(ports, "%d %d", &http_, &ftp_) != 2) throw std::runtime_error("no servers");
    std::fclose(ports);
  }

  ~FileServers() {
    close(to_child_);  // the script ends with its input
    waitpid(pid_, nullptr, 0);
  }
  FileServers(const FileServers&) = delete;
  FileServers& operator=(const FileServers&) = delete;

  std::string http(const std::string& path) const {
    return "http://127.0.0.1:" + std::to_string(http_) + path;
  }
  std::string ftp(const std::string& path) const {
    return "ftp://127.0.0.1:" + std::to_string(ftp_) + path;
  }

 private:
  pid_t pid_ = 0;
  int to_child_ = -1;
  int http_ = 0;
  int ftp_ = 0;
};

}  // namespace pcrb_test
