// chainmail-import BYTES SECONDS TASK PATH [ARGUMENT…]: run_import (files/import/import_process.h) starts this program.

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <string_view>

#include "files/import/handover.h"
#include "files/import/program/tasks.h"
#include "files/import/sandbox.h"
#include "mesh/error.h"

namespace chainmail::import {
namespace {

constexpr const char* help =
    "Reads meshes with CGAL, Gmsh and teem, in a sandbox, for chainmail and workbench.\n"
    "Usage: chainmail-import BYTES SECONDS TASK PATH [ARGUMENT...]\n\n"
    "Only these programs start it: they pass open files and receive the mesh.\n\n"
    "Options:\n"
    "  --help     print this help and exit\n"
    "  --version  print version and licence, and exit";
constexpr const char* version_text =
    "chainmail-import " CHAINMAIL_VERSION
    "\nGPL-3 or later, because it links CGAL (GPL-3 or later) and Gmsh (GPL-2 or later).\n"
    "It also links pugixml (MIT), teem (LGPL-2.1 or later) and libseccomp (LGPL-2.1). Its own source is under the MIT "
    "licence.";
constexpr const char* sandboxed = "Sandbox: Landlock and seccomp. The libraries can read only the file that is opened.";
constexpr const char* sandboxed_without_landlock =
    "Sandbox: seccomp only. The libraries can read your other files, because this system has no Landlock (Linux 5.13 "
    "or\n"
    "later, if it is turned on).";

void limit(int resource, rlim_t to, rlim_t until_killed = 0) {
  const rlimit both{to, to + until_killed};
#ifdef __linux__
  setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
#else
  setrlimit(resource, &both);
#endif
}

/// Gmsh recurses deeply. It would raise this limit itself, but cannot in the sandbox.
void use_all_of_the_stack() {
  rlimit stack{};
  if (getrlimit(RLIMIT_STACK, &stack) == 0) {
    stack.rlim_cur = stack.rlim_max;
    setrlimit(RLIMIT_STACK, &stack);
  }
}

void set_limits(const char* bytes, const char* seconds) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends with its caller
#endif
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, std::strtoull(seconds, nullptr, 10), 1);  // SIGXCPU comes first, so the caller knows the reason
#ifndef __SANITIZE_ADDRESS__                                  // a sanitizer takes more address space than any limit
  limit(RLIMIT_AS, std::strtoull(bytes, nullptr, 10));
#else
  static_cast<void>(bytes);
#endif
}

/// Closes descriptors that the parent did not intend to pass.
void close_others() {
#ifdef __linux__
  close_range(STDERR_FILENO + 1, result_channel - 1, 0);
  close_range(last_input + 1, ~0U, 0);
#endif  // elsewhere the caller marks its descriptors to be closed
}

void report_share(double share) {
  if (write(share_channel, &share, sizeof share) < 0) {
    std::_Exit(1);  // the caller has ended
  }
}

using Task = std::function<Imported(const std::filesystem::path&, const std::vector<std::string>&)>;

const std::map<std::string, Task>& tasks() {
  static const std::map<std::string, Task> all{
      {"msh", [](const auto& path, const auto&) { return Imported(read_by_gmsh(path)); }},
      {"vtu", [](const auto& path, const auto&) { return Imported(read_vtk_xml(path)); }},
      {"nrrd", [](const auto& path, const auto&) { return Imported(read_nrrd(path)); }},
      {"fill",
       [](const auto& path, const auto& arguments) {
         return Imported(fill_surface(path, std::strtod(arguments.at(0).c_str(), nullptr), report_share));
       }},
      {"simplify",
       [](const auto& path, const auto& arguments) {
         return Imported(simplify_surface(path, std::strtoull(arguments.at(0).c_str(), nullptr, 10), report_share));
       }},
      {"close", [](const auto& path, const auto&) { return Imported(close_surface(path, report_share)); }},
  };
  return all;
}

/// Returns the descriptors of the files that the caller passed.
std::vector<int> inputs() {
  std::vector<int> open;
  for (int input = first_input; input <= last_input; ++input) {
    if (fcntl(input, F_GETFD) >= 0) {
      open.push_back(input);
    }
  }
  return open;
}

/// True if the person asks by name to read files without a sandbox, where there is none.
bool may_do_without_sandbox() {
  const char* asked = std::getenv("CHAINMAIL_WITHOUT_SANDBOX");
  return asked != nullptr && std::string_view(asked) == "1";
}

/// Enters the sandbox before a library reads the file.
Imported carry_out(const std::string& task, const std::filesystem::path& path,
                   const std::vector<std::string>& arguments) {
  if (!enter_sandbox({path.parent_path(), inputs()}) && !may_do_without_sandbox()) {
    return Refusal{"this system cannot sandbox the program that reads this format (seccomp is missing)",
                   "use another format or, for files that you trust, set CHAINMAIL_WITHOUT_SANDBOX=1"};
  }
  report_share(0);  // the caller knows that this program works
  try {
    return tasks().at(task)(path, arguments);
  } catch (const Error& error) {
    return Refusal{error.problem(), error.remedy()};
  }
}

bool hand_over(const std::vector<std::byte>& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(result_channel, bytes.data() + done, bytes.size() - done);
    if (written <= 0) {
      return false;
    }
    done += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace
}  // namespace chainmail::import

int main(int count, char** words) {
  using namespace chainmail::import;
  if (const std::string_view asked = count == 2 ? words[1] : ""; asked == "--help" || asked == "--version") {
    std::puts(asked == "--help" ? help : version_text);
    if (asked == "--version") {
      std::puts(sandbox_hides_files() ? sandboxed : sandboxed_without_landlock);
    }
    return 0;
  }
  if (count < 5) {
    std::fputs("chainmail-import: only chainmail and workbench start this program, to read meshes\n", stderr);
    return 2;
  }
  close_others();
  set_limits(words[1], words[2]);
  use_all_of_the_stack();
  try {
    const auto imported = carry_out(words[3], words[4], {words + 5, words + count});
    // Skips the cleanup of the libraries: it may crash after a damaged file.
    std::_Exit(hand_over(chainmail::encode_imported(imported)) ? 0 : 1);
  } catch (const std::bad_alloc&) {
    std::_Exit(out_of_memory);
  } catch (...) {
    std::_Exit(1);
  }
}
