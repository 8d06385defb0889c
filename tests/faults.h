#pragma once

#include <string>
#include <vector>

namespace chainmail::test {

/// A system call that a program makes to write a file.
enum class FileCall { open, write, sync, rename };

/// All of them, with their names.
struct NamedCall {
  FileCall call;
  const char* name;
};
const std::vector<NamedCall>& file_calls();

/// Lets the n-th call (from 1) of a kind fail with this errno, if it concerns a file below `folder`. Calls after it
/// work again; with `stays`, they fail, too. The program that links this file makes all its calls through it, also
/// those of libraries.
void arm_fault(const std::string& folder, FileCall call, int n, int error, bool stays);
/// Lets all calls work again. Returns true if the armed one has failed.
bool disarm_fault();

}  // namespace chainmail::test
