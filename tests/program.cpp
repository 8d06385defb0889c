#include "program.h"

#include <cstdio>

namespace chainmail::test {
namespace {

/// The last class that was made known.
constinit const TestClass* last = nullptr;

const TestClass* find(const QByteArray& name) {
  const TestClass* found = last;
  while (found != nullptr && found->name() != name) {
    found = found->next;
  }
  return found;
}

int listClasses(const char* program) {
  std::fprintf(stderr, "usage: %s CLASS [options of Qt Test]\nThe classes:\n", program);
  for (const TestClass* known = last; known != nullptr; known = known->next) {
    std::fprintf(stderr, "  %s\n", known->name().constData());
  }
  return 2;
}

}  // namespace

TestClass::TestClass(const QMetaObject& its_type, Run its_run) : type(its_type), run(its_run), next(last) {
  last = this;
}

QByteArray TestClass::name() const {
  const QByteArray file = QByteArray(type.className()).split(':').value(2);  // of chainmail::test_cuts::CutsTest
  return file.startsWith("test_") ? file.mid(5) : file;
}

}  // namespace chainmail::test

/// Runs the class that the first argument names, with the other arguments.
int main(int argc, char** argv) {
  const chainmail::test::TestClass* chosen = argc > 1 ? chainmail::test::find(argv[1]) : nullptr;
  if (chosen == nullptr) {
    return chainmail::test::listClasses(argv[0]);
  }
  argv[1] = argv[0];
  return chosen->run(argc - 1, argv + 1);
}
