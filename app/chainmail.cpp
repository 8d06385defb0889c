#include <csignal>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <system_error>

#include "command_line/common.h"
#include "files/text/outputs.h"
#include "files/text/temporary_folder.h"
#include "files/text/text.h"
#include "mesh/error.h"

namespace {

enum ExitCode { done = 0, failed = 1, bad_usage = 2 };

/// Prints an error in one line. Characters that cannot be printed are replaced.
ExitCode complain(std::string_view message, ExitCode code) {
  std::cerr << "chainmail: " << chainmail::printable(message) << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the file size limit (ulimit -f) then fails like one on a full disk
  chainmail::remove_folders_on_signals();
  try {
    chainmail::command_line::run(argc, argv);
    return done;
  } catch (const chainmail::WriteFailure& failure) {
    return complain(failure.what(), failed);
  } catch (const chainmail::Error& error) {
    return complain(error.what(), bad_usage);
  } catch (const std::bad_alloc&) {
    return complain("memory: not enough memory; use a smaller mesh", failed);
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(
        chainmail::shown(error.path1()) + ": " + error.code().message() + "; check the path and its permissions",
        failed);
  } catch (const std::system_error& error) {  // of a thread
    return complain("threads: none can be started (" + error.code().message() +
                        "); close other programs, or raise the limits of this user (ulimit)",
                    failed);
  } catch (const std::exception& error) {
    return complain(std::string("internal: ") + error.what() + "; please report it", failed);
  }
}
