#include "mesh/error.h"

#include <new>
#include <system_error>

namespace chainmail {
namespace {

constexpr auto few_words = "out of memory";  // short enough for a string that allocates nothing

/// Throws the exception that is being handled again, and describes it by its type.
std::string described(std::string_view where) {
  const std::string begin = std::string(where) + ": ";
  try {
    throw;
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return begin + "there is not enough memory; save your work, then close other programs or use a smaller mesh";
  } catch (const std::system_error& error) {
    return begin + "the system refuses it (" + error.what() + "); save your work, then close other programs";
  } catch (const std::exception& error) {
    return begin + "it failed (" + error.what() + "); save your work, and try it in another way";
  } catch (...) {
    return begin + "it failed for an unknown reason; save your work, and try it in another way";
  }
}

}  // namespace

std::string failure_sentence(std::string_view where) noexcept {
  try {
    return described(where);
  } catch (...) {
    return few_words;
  }
}

}  // namespace chainmail
