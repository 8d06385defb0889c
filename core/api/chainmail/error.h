#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

/// The public interface of the solver library.
namespace chainmail::api {

/// The one exception for bad input: arguments, files and objects that a method cannot work on. what() is one sentence:
/// where it happened, what is wrong, and what to do. Nothing has changed when it is thrown.
class Error : public std::runtime_error {
 public:
  /// Makes an error. A method of your own may throw one, too.
  Error(const std::string& where, const std::string& problem, const std::string& remedy)
      : std::runtime_error(where + ": " + problem + "; " + remedy), where_(where), rest_(problem, remedy) {}

  /// The argument, element or file that is wrong.
  const std::string& where() const { return where_; }
  /// What is wrong with it.
  const std::string& problem() const { return rest_.first; }
  /// What to do about it.
  const std::string& remedy() const { return rest_.second; }
  /// Returns the same error about another argument, element or file.
  Error at(const std::string& where) const { return {where, rest_.first, rest_.second}; }

 private:
  std::string where_;
  std::pair<std::string, std::string> rest_;
};

/// A write that began and could not be finished, for example on a full disk. The old file stays.
class WriteFailure : public Error {
 public:
  using Error::Error;
};

/// Thrown by work that was cancelled (see Job). It is not an Error: nothing is wrong, and there is no result.
class Cancelled : public std::exception {
 public:
  /// Returns "cancelled".
  const char* what() const noexcept override { return "cancelled"; }
};

}  // namespace chainmail::api
