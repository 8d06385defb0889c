#pragma once

#include <cstddef>
#include <cstdint>

/// The limits of files. A reader refuses what is beyond them in one sentence, before it takes memory for it. The manual
/// lists them in resources/manual/formats.md.
namespace chainmail::limits {

// All files
inline constexpr std::uint64_t file_bytes = std::uint64_t{4} << 30;  // ten times that of the largest mesh allowed
inline constexpr std::size_t metaimage_header_bytes = 100'000;       // of a volume

inline constexpr std::size_t nrrd_header_bytes = std::size_t{1} << 20;  // may contain long comments
/// Lines of such a header. For each of them, teem compares it with all others before it.
inline constexpr std::size_t nrrd_header_lines = 10'000;

// Texts, in UTF-8 (bytes)
inline constexpr std::size_t name_bytes = 255;  // of an object and of a file, and the title of a lesson or of a step
inline constexpr std::size_t caption_bytes = 4096;    // text of a step of a lesson
inline constexpr std::size_t text_bytes = 65'536;     // any other text in a file of JSON
inline constexpr std::size_t preset_name_bytes = 60;  // of a preset of softness

// Numbers of parts
/// Values in a file of JSON, of 16 bytes. An object or array, and a key, take the memory of several and count as such.
/// Long arrays of numbers in sessions and recorded moves do not count.
inline constexpr std::size_t json_values = 10'000'000;
inline constexpr std::size_t values_of_container = 4, values_of_key = 5;
inline constexpr std::size_t json_levels = 16;  // of arrays and objects: protects memory and stack; our formats need 6
inline constexpr std::size_t presets = 1000;    // of softness, in one file
inline constexpr std::size_t session_panels = 16;        // of a session
inline constexpr std::size_t session_moves = 1'000'000;  // with the links and elements that they name
inline constexpr std::size_t moves = 10'000'000;         // in a file
/// Elements, links, triangles and cells of all meshes after splits of recorded moves, which are made one after another
/// while the moves are read.
inline constexpr std::uint64_t split_parts = 100'000'000;
inline constexpr std::size_t lesson_steps = 1000;  // of a lesson
/// Largest grid of a VTK file that has fewer bytes than points.
inline constexpr std::uint64_t points_without_values = 100'000;

// Volumes
/// Largest number of voxels of a file. Larger volumes are refused.
inline constexpr std::uint64_t voxels = std::uint64_t{1} << 30;
/// Largest number of voxels in memory. A larger volume is averaged while it is read.
inline constexpr std::uint64_t voxels_in_memory = std::uint64_t{1} << 27;
/// Files that the header of a volume may name; those of NRRD are all open at once.
inline constexpr std::uint64_t metaimage_files = 10'000, nrrd_files = 256;
/// Largest ratio of the size of data to their size when compressed. zlib does not reach it (RFC 1951).
inline constexpr std::uint64_t compression_ratio = 1040;

}  // namespace chainmail::limits
