#pragma once

#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <utility>

namespace chainmail::test {

inline constexpr int default_explored = 50;

/// Returns the parameters of the explored inputs: those in RapidCheck's own variable RC_PARAMS, else a random seed. To
/// repeat a run, the number of successes must be the same too, because inputs grow with the share of them that is done.
inline rc::detail::TestParams drawn_parameters() {
  rc::detail::Configuration drawn;
  drawn.testParams.seed = std::random_device()();
  drawn.testParams.maxSuccess = default_explored;
  const char* given = std::getenv("RC_PARAMS");
  const auto all = rc::detail::configFromString(given == nullptr ? "" : given, drawn);
  // RapidCheck also reads the variable, and prints the seed that it finds there.
  setenv("RC_PARAMS", rc::detail::configToString(all).c_str(), 1);
  return all.testParams;
}
/// Drawn before main: later, a thread of Qt Test reads the environment.
inline const rc::detail::TestParams drawn_once = drawn_parameters();

/// Checks a property on inputs that these parameters draw, and prints the result. `inputs` describes them.
template <class Property>
bool check_with(const rc::detail::TestParams& parameters, const std::string& sentence, const Property& property,
                const std::string& inputs) {
  // RapidCheck's own listener prints how to repeat a single input, but our tests cannot do that.
  rc::detail::TestListenerAdapter silent;
  const auto result =
      rc::detail::checkTestable(property, rc::detail::TestMetadata{sentence, sentence}, parameters, silent);
  std::cerr << "- " << sentence << " (" << inputs << ")\n";
  rc::detail::printResultMessage(result, std::cerr);
  std::cerr << std::endl;
  return result.template is<rc::detail::SuccessResult>();
}

/// Checks once what draws nothing, but uses RC_ASSERT.
template <class Property>
bool check_once(const std::string& sentence, const Property& property) {
  rc::detail::TestParams once;
  once.maxSuccess = 1;
  return check_with(once, sentence, property, "once");
}

/// Checks a property, which uses RC_ASSERT, on random inputs: on the same 50 in every run, then on 50 new ones. The
/// line above a result shows how to repeat the new ones. CHAINMAIL_EXPLORE=40 draws 40 times as many new ones, as the
/// long run does. `inputs`: fewer than 50, for inputs that take long.
template <class Property>
bool check_property(const std::string& sentence, const Property& property, int inputs = default_explored) {
  rc::detail::TestParams fixed;
  fixed.seed = 2004;
  fixed.maxSuccess = inputs;
  rc::detail::TestParams explored = drawn_once;
  if (explored.maxSuccess == default_explored) {
    const char* factor = std::getenv("CHAINMAIL_EXPLORE");
    explored.maxSuccess = std::min(inputs, default_explored) * (factor == nullptr ? 1 : std::max(std::atoi(factor), 1));
  }
  const std::string repeat = "explored inputs, repeated by RC_PARAMS=\"seed=" + std::to_string(explored.seed) +
                             " max_success=" + std::to_string(explored.maxSuccess) + "\"";
  return check_with(fixed, sentence, property, "inputs of every run") &&
         check_with(explored, sentence, property, repeat);
}

}  // namespace chainmail::test
