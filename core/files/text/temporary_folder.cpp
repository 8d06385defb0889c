#include "files/text/temporary_folder.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

#include "files/text/text.h"
#include "mesh/error.h"

namespace chainmail {
namespace {

std::filesystem::path folder_for_temporary_files() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) {
    const char* given = std::getenv("TMPDIR");
    throw Error(given != nullptr ? shown(given) : "TMPDIR", "it cannot take temporary files (" + error.message() + ")",
                "set TMPDIR to a folder");
  }
  return folder;
}

// The paths of all folders, for the handler of signals. It may use only what is safe there, so no containers.
std::array<std::atomic<char*>, 32> present{};

void enter(const std::filesystem::path& path) {
  char* const copy = strdup(path.c_str());
  for (auto& place : present) {
    char* none = nullptr;
    if (place.compare_exchange_strong(none, copy)) {
      return;
    }
  }
  free(copy);
}

void leave(const std::filesystem::path& path) {
  for (auto& place : present) {
    char* there = place.load();
    if (there != nullptr && path == there && place.compare_exchange_strong(there, nullptr)) {
      free(there);
    }
  }
}

/// Removes all folders with another program, because no function that lists a folder is safe in a handler.
void remove_folders(int signal) {
  for (auto& place : present) {
    if (const char* path = place.exchange(nullptr)) {
      const pid_t remover = fork();
      if (remover == 0) {
        execl("/bin/rm", "rm", "-rf", "--", path, nullptr);
        _exit(1);
      }
      while (remover > 0 && waitpid(remover, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
  }
  std::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

void remove_folders_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) {  // not for nohup
      struct sigaction handler {};
      handler.sa_handler = remove_folders;
      handler.sa_flags = SA_RESTART;
      sigfillset(&handler.sa_mask);
      sigaction(signal, &handler, nullptr);
    }
  }
}

TemporaryFolder::TemporaryFolder() {
  const auto folder = folder_for_temporary_files();
  std::random_device random;
  for (;;) {
    path_ = folder / ("chainmail-" + std::to_string(random()) + "-" + std::to_string(random()));
    enter(path_);  // before it exists, so that no signal comes between
    if (mkdir(path_.c_str(), S_IRWXU) == 0) {
      return;
    }
    const int reason = errno;
    leave(path_);
    if (reason != EEXIST) {
      errno = reason;
      throw Error(shown(path_), "the folder cannot be created (" + system_reason() + ")",
                  "free some space, or set TMPDIR to another folder");
    }
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
  leave(path_);
}

}  // namespace chainmail
