#pragma once

// What both ends of the import program know.
namespace chainmail::import {

inline constexpr int result_channel = 30;  // where it writes the hand-over
inline constexpr int share_channel = 31;   // where it writes how much is done, doubles from 0 to 1
inline constexpr int first_input = 32;     // the files that it reads, one after another
inline constexpr int last_input = 39;
inline constexpr int out_of_memory = 3;  // its exit status

}  // namespace chainmail::import
