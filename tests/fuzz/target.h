#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>

#include "mesh/error.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"

namespace chainmail::fuzz {

/// Half of the inputs of a JSON reader stay JSON: bytes alone would hardly ever get past the parser.
enum class Kind { bytes, json };

/// A reader of this program.
struct Target {
  using Read = int (*)(const std::uint8_t* data, std::size_t size);

  Target(const char* its_name, Read its_read, Kind its_kind = Kind::bytes);

  const char* name;
  Read read;
  Kind kind;
  const Target* next;
};

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program, so that the fuzzer keeps the input.
[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}

inline void expect(bool holds, const char* what) {
  if (!holds) {
    fail(what);
  }
}

/// Checks that an error is one line without control characters.
inline void check_sentence(const std::string& sentence) {
  for (const unsigned char character : sentence) {
    if (character < ' ' || character == 0x7f) {
      fail("control characters in a sentence: " + sentence);
    }
  }
}

/// Checks the conditions that every object must meet.
inline void check_mesh(const Mesh& mesh) {
  for (const double coordinate : mesh.rest) {
    expect(std::abs(coordinate) <= coordinate_limit, "a coordinate that is none");  // also fails for NaN
  }
  for (const auto& [a, b] : mesh.links) {
    expect(a < b && b < mesh.element_count(), "a link of no elements");
  }
  const auto expect_ids = [&](const auto& groups) {
    for (const auto& group : groups) {
      for (const ElementId id : group) {
        expect(id < mesh.element_count(), "a face or cell of no elements");
      }
    }
  };
  expect_ids(mesh.triangles);
  expect_ids(mesh.tetrahedra);
  expect_ids(mesh.hexahedra);
}

/// Calls a reader, which must return or throw Error. Any other exception ends the program.
template <class Read>
void read_or_refuse(Read read) {
  try {
    read();
  } catch (const Error& error) {
    check_sentence(error.what());
  } catch (const Cancelled&) {
  }
}

/// Returns the text that a function writes.
template <class Write>
std::string written(Write write) {
  std::ostringstream out;
  write(out);
  return out.str();
}

}  // namespace chainmail::fuzz
