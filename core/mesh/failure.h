#pragma once

#include <string>
#include <string_view>

namespace chainmail {

/// Returns one sentence about the exception that is being handled: where, what is wrong, and what to do. Call it in a
/// catch block. An Error brings its own text; for anything else, `where` names what failed. Never throws: if there is
/// no memory for the sentence, it returns a few words.
std::string failure_sentence(std::string_view where) noexcept;

}  // namespace chainmail
