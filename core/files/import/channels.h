#pragma once

#include "files/text/limits.h"

// Numbers that the import program and its caller share.
namespace chainmail::import {

inline constexpr int result_channel = 30;  // receives the result
inline constexpr int share_channel = 31;   // receives the share that is done, doubles from 0 to 1
inline constexpr int first_input = 32;     // the files that it reads, in order
inline constexpr int last_input = first_input + int(limits::nrrd_files) - 1;
inline constexpr int out_of_memory = 3;  // its exit status

}  // namespace chainmail::import
