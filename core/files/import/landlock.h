#pragma once

#include <filesystem>
#include <span>

namespace chainmail::import {

/// Landlock is the part of the kernel by which a program gives up access to files (Linux 5.13 and later). Returns the
/// version of its interface, or 0 if the kernel does not have it or does not use it.
int landlock_version();

/// Gives up access to all files, except that this thread, and the threads it starts, may still read what is in a folder
/// and may open these files again, for example by /proc/self/fd. An empty path means no folder. Open descriptors stay
/// as they are. The thread must not be able to gain privileges
/// (PR_SET_NO_NEW_PRIVS). Returns false if this fails.
[[nodiscard]] bool give_up_files(const std::filesystem::path& folder, std::span<const int> files);

}  // namespace chainmail::import
