#pragma once

namespace chainmail::import {

/// Closes a sandbox around this process, for good. From then on it can compute, start threads, read files and write to
/// what is already open. It cannot start a program or a process, open a file for writing, change or remove one, open a
/// socket, or touch another process: these calls fail.
///
/// Returns false where the kernel cannot do this. Then no library may see a byte of a foreign file.
[[nodiscard]] bool enter_sandbox();

}  // namespace chainmail::import
