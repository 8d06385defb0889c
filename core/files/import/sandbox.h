#pragma once

namespace chainmail::import {

/// Puts this process into a sandbox that it cannot leave. It can then compute, start threads, read files and write to
/// open descriptors. It cannot start a program or a process, open a file for writing, change or remove a file, open a
/// socket, or affect another process: these calls fail.
///
/// Returns false if the kernel does not support this. Then no library may read a foreign file.
[[nodiscard]] bool enter_sandbox();

}  // namespace chainmail::import
