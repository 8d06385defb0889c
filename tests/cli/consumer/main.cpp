#include <chainmail/chainmail.h>
#include <chainmail/solver/deformer.h>

#include <iostream>

namespace cm = chainmail;

namespace {

/// A format of another library needs chainmail-import. Where it is missing, the error says so.
bool misses_import_program(const char* path) {
  try {
    cm::ReadOptions options;
    options.import_program = "/nowhere";
    cm::read_mesh(path, options);
  } catch (const cm::Error& error) {
    return error.where() == "chainmail-import";
  }
  return false;
}

}  // namespace

// A program that uses the installed library. It pulls the corner of a 3x3 grid two mesh units to the left.
//   consumer FILE.msh
int main(int argc, char** argv) {
  cm::Deformer deformer(cm::generate({cm::MeshKind::grid, {3, 3, 1}}), cm::Algorithm::natural_queue);
  const cm::PassCount pass = deformer.move(0, {-2, 0, 0});
  std::cout << "chainmail " << VERSION << ": " << pass.moved << " moved\n";
  return argc == 2 && misses_import_program(argv[1]) && cm::measure_violation(deformer.body()).max < 1e-12 ? 0 : 1;
}
