#include <chainmail/chainmail.h>

#include <iostream>

namespace cm = chainmail::api;

namespace {

/// A format of another library needs chainmail-import. Where it is missing, the error says so.
bool misses_import_program(const char* path) {
  try {
    cm::read_mesh(path, {.import_program = "/nowhere"});
  } catch (const cm::Error& error) {
    return error.where() == "chainmail-import";
  }
  return false;
}

}  // namespace

// A program that uses the installed library. It pulls the corner of a 3x3 grid two mesh units to the left.
//   consumer FILE.msh
int main(int argc, char** argv) {
  cm::Deformer deformer(cm::make_grid(3, 3), "natural-queue");
  const cm::MoveResult result = deformer.move(0, {-2, 0, 0});
  std::cout << "chainmail " << cm::version() << ": " << result.moved << " moved\n";
  return argc == 2 && misses_import_program(argv[1]) && cm::violation(deformer.body()).max < 1e-12 ? 0 : 1;
}
