#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace chainmail::command_line {

/// Limits of work in a process of its own, with the programs that it starts. `chainmail thumbnail` works so: file
/// managers run it on files that nobody has looked at.
struct WorkLimits {
  std::uint64_t seconds = 2;  // of processor time, an even number: programs that the work starts get half of it
  std::uint64_t memory = 0;   // address space of each process (bytes)
  std::uint64_t answer = 0;   // size of the answer, and of each file that it writes (bytes)
};

/// Runs `work` in a process of its own and returns its answer. If the work throws an Error, so does this function. Ends
/// the work beyond a limit, and throws Error about `where`. Files that it leaves in the folder for temporary files are
/// removed.
///
/// Call this on the only thread of a process.
std::string run_limited(const std::string& where, const WorkLimits& limits, const std::function<std::string()>& work);

/// For the work, before it starts a program: true if it has used half of its time itself, so that none is left for a
/// program.
bool has_used_half(const WorkLimits& limits);

/// For the work, when all its files are read: counts the processor time of programs that it started, and enters a
/// sandbox in which it can only compute and answer.
void finish_in_sandbox();

}  // namespace chainmail::command_line
