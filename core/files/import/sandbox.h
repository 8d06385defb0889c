#pragma once

#include <filesystem>
#include <vector>

namespace chainmail::import {

/// The files that a program may still read in the sandbox, in addition to its open ones.
struct SandboxFiles {
  std::filesystem::path folder;  // it may read what is in this folder
  std::vector<int> inputs;       // open files that it may open again, for reading, for example by /proc/self/fd
};

/// Puts this process into a sandbox that it cannot leave. It can then compute, read these files, and write to open
/// pipes. It cannot start a thread, a process or a program, open a file for writing, change or remove a file, open a
/// socket, or affect another process: these calls fail. Threads that run already go on, in the sandbox.
///
/// Files other than the given ones are hidden by Landlock; only the size and times of a file stay visible to a process
/// that knows its path. Where the kernel does not have Landlock (see sandbox_hides_files), it can read all files of the
/// user.
///
/// Call this on the only thread of a process: Landlock does not restrict other threads. Returns false if the kernel
/// does not support the sandbox. Then no library may read a foreign file.
[[nodiscard]] bool enter_sandbox(const SandboxFiles& files);

/// True if the kernel has Landlock: files other than those that enter_sandbox names cannot be read.
bool sandbox_hides_files();

}  // namespace chainmail::import
