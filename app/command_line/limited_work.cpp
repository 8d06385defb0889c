#include "command_line/limited_work.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "chainmail/error.h"
#include "chainmail/files.h"
#include "chainmail/text.h"
#include "files/import/sandbox.h"

namespace chainmail::command_line {
namespace {

// The first byte of an answer.
constexpr char is_result = 'r', is_error = 'e', is_out_of_memory = 'm', is_fault = 'f';
constexpr char between_texts = '\0';

constexpr const char* what_to_do = "use a smaller file, or open it in the workbench";

api::Error beyond_time(const std::string& where, const WorkLimits& limits) {
  return {where, "this takes more than " + std::to_string(limits.seconds) + " s of processor time", what_to_do};
}
api::Error beyond_memory(const std::string& where, const WorkLimits& limits) {
  return {where, "this takes more than " + std::to_string(limits.memory >> 20) + " MiB of memory", what_to_do};
}

void set_limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  const rlimit both{soft, hard};
  setrlimit(resource, &both);
}

/// Handles the first SIGXCPU: this process has used half of its time. The next one ends it.
void use_second_half(int /*signal*/) {
  rlimit both{};
  getrlimit(RLIMIT_CPU, &both);
  set_limit(RLIMIT_CPU, both.rlim_max - 1, both.rlim_max);
  std::signal(SIGXCPU, SIG_DFL);
}

/// The programs that this process starts inherit the limits, but no handler: they get half of the time, so that their
/// results can be used. SIGXCPU comes at the soft limit, SIGKILL at the hard one.
void set_limits(const WorkLimits& limits) {
  std::signal(SIGXCPU, use_second_half);
  set_limit(RLIMIT_CORE, 0, 0);
  set_limit(RLIMIT_CPU, limits.seconds / 2, limits.seconds + 1);
  set_limit(RLIMIT_FSIZE, limits.answer, limits.answer);
#ifndef __SANITIZE_ADDRESS__  // a sanitizer takes more address space than any limit
  set_limit(RLIMIT_AS, limits.memory, limits.memory);
#endif
}

/// Both ends of a pipe. The destructor closes them.
class WorkPipe {
 public:
  WorkPipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw api::Error("chainmail", "a pipe cannot be created (" + api::system_reason() + ")", "close other programs");
    }
  }
  WorkPipe(const WorkPipe&) = delete;
  WorkPipe& operator=(const WorkPipe&) = delete;
  ~WorkPipe() {
    close(ends_[0]);
    close_in();
  }

  void close_in() {
    close(ends_[1]);
    ends_[1] = -1;
  }
  void write_all(const std::string& bytes) const {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t written = ::write(ends_[1], bytes.data() + done, bytes.size() - done);
      if (written < 0 && errno != EINTR) {
        std::_Exit(1);  // the reader has ended
      }
      done += written > 0 ? std::size_t(written) : 0;
    }
  }
  /// Reads to the end, or a little more than `most` bytes.
  std::string read_all(std::uint64_t most) const {
    std::string bytes;
    std::vector<char> part(std::size_t{1} << 16);
    while (bytes.size() <= most) {
      const ssize_t got = ::read(ends_[0], part.data(), part.size());
      if (got == 0 || (got < 0 && errno != EINTR)) {
        break;
      }
      bytes.append(part.data(), got > 0 ? std::size_t(got) : 0);
    }
    return bytes;
  }

 private:
  std::array<int, 2> ends_{-1, -1};
};

std::string answer_of(const std::function<std::string()>& work) {
  try {
    return is_result + work();
  } catch (const api::Error& error) {
    return is_error + error.where() + between_texts + error.problem() + between_texts + error.remedy();
  } catch (const std::bad_alloc&) {
    return {is_out_of_memory};
  } catch (const std::system_error& error) {  // also of file systems
    return is_error + ("system" + (between_texts + error.code().message())) + between_texts +
           "close other programs, or check the path and its permissions";
  } catch (const std::exception& error) {
    return is_fault + std::string(error.what());
  }
}

[[noreturn]] void throw_error(std::string_view texts) {
  std::array<std::string, 3> parts;
  for (std::string& part : parts) {
    const std::size_t end = std::min(texts.find(between_texts), texts.size());
    part = api::printable(texts.substr(0, end));
    texts.remove_prefix(std::min(end + 1, texts.size()));
  }
  throw api::Error(parts[0], parts[1], parts[2]);
}

/// Waits for the end of a process that was ended, or is about to end, and returns the status of waitpid.
int status_of(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string result_of(const std::string& where, const WorkLimits& limits, const std::string& answer, int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    throw beyond_time(where, limits);
  }
  if (answer.size() > limits.answer || !WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.empty()) {
    throw api::Error(where, "the process that reads it failed", "use another file, and report this one");
  }
  const std::string_view rest = std::string_view(answer).substr(1);
  switch (answer.front()) {
    case is_result:
      return std::string(rest);
    case is_error:
      throw_error(rest);
    case is_out_of_memory:
      throw beyond_memory(where, limits);
    default:
      throw std::runtime_error(api::printable(rest));
  }
}

}  // namespace

bool has_used_half(const WorkLimits& limits) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return std::uint64_t(used.ru_utime.tv_sec + used.ru_stime.tv_sec) >= limits.seconds / 2;
}

std::string run_limited(const std::string& where, const WorkLimits& limits, const std::function<std::string()>& work) {
  const api::TemporaryFolder folder;  // removed even if the work is killed
  WorkPipe pipe;
  const pid_t process = fork();
  if (process < 0) {
    throw api::Error("chainmail", "a process cannot be started (" + api::system_reason() + ")", "close other programs");
  }
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with its caller
    setenv("TMPDIR", folder.path().c_str(), 1);
    set_limits(limits);
    pipe.write_all(answer_of(work));
    std::_Exit(0);
  }
  pipe.close_in();
  const std::string answer = pipe.read_all(limits.answer);
  if (answer.size() > limits.answer) {
    kill(process, SIGKILL);
  }
  return result_of(where, limits, answer, status_of(process));
}

void finish_in_sandbox() {
  rusage started{};
  getrusage(RUSAGE_CHILDREN, &started);
  if (started.ru_utime.tv_sec > 0 || started.ru_utime.tv_usec > 0) {
    std::signal(SIGXCPU, SIG_DFL);  // the programs had the other half
  }
  // Without it, the limits still apply.
  static_cast<void>(import::enter_sandbox());
}

}  // namespace chainmail::command_line
