// fuzz READER [OPTION of libFuzzer…]: gives damaged input to one reader. fuzz without a reader lists them.

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include "fuzz/damage.h"
#include "fuzz/target.h"

namespace chainmail::fuzz {
namespace {

constinit const Target* last = nullptr;
constinit const Target* chosen = nullptr;

}  // namespace

Target::Target(const char* its_name, Read its_read, Kind its_kind)
    : name(its_name), read(its_read), kind(its_kind), next(last) {
  last = this;
}

}  // namespace chainmail::fuzz

extern "C" {

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Takes the first argument, the name of the reader.
int LLVMFuzzerInitialize(int* count, char*** words) {
  using namespace chainmail::fuzz;
  for (chosen = last; chosen != nullptr && (*count < 2 || std::strcmp(chosen->name, (*words)[1]) != 0);) {
    if (*count < 2) {
      std::puts(chosen->name);
    }
    chosen = chosen->next;
  }
  if (chosen == nullptr) {
    std::exit(*count < 2 ? 0 : 2);
  }
  (*words)[1] = (*words)[0];
  ++*words;
  --*count;
  return 0;
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  using namespace chainmail::fuzz;
  if (chosen->kind == Kind::bytes || seed % 2 == 0) {
    return LLVMFuzzerMutate(data, size, most);
  }
  std::string text(text_of(data, size));
  Damage(seed).apply_to_json(text);
  text.resize(std::min(text.size(), most));
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return chainmail::fuzz::chosen->read(data, size);
}
}
