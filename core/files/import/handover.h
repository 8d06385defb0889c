#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "files/formats/imported.h"
#include "files/formats/volume.h"
#include "files/text/limits.h"
#include "mesh/error.h"

namespace chainmail {

/// The reason why the import program returns nothing: the problem and the remedy of an Error.
struct Refusal {
  std::string problem;
  std::string remedy;
};

/// The result of the import program, which it sends through a pipe.
using Imported = std::variant<ImportedMesh, Volume, Refusal>;

/// Returns the bytes of a result: a mark, the kind, counts, then numbers in the machine's own layout, because both
/// programs run on the same machine.
std::vector<std::byte> encode_imported(const Imported& imported);

/// Returns the error for an answer that the import program never gives, unless a damaged file made it do so.
Error damaged_answer(const std::filesystem::path& path);

/// Reads these bytes. It checks every count against the number of bytes before it allocates memory, and every id
/// against the number of elements. Throws Error about `path`, the file that was read, if the bytes are damaged, if a
/// coordinate is not finite or beyond coordinate_limit, or if there are more than element_limit elements.
Imported decode_imported(std::span<const std::byte> bytes, const std::filesystem::path& path);

}  // namespace chainmail

// Numbers that the import program and its caller share.
namespace chainmail::import {

inline constexpr int result_channel = 30;  // receives the result
inline constexpr int share_channel = 31;   // receives the share that is done, doubles from 0 to 1
inline constexpr int first_input = 32;     // the files that it reads, in order
inline constexpr int last_input = first_input + int(limits::nrrd_files) - 1;
inline constexpr int out_of_memory = 3;  // its exit status

}  // namespace chainmail::import
