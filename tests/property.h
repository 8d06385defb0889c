#pragma once

#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <utility>

namespace chainmail::test {

/// How an explored run is repeated: RapidCheck's own variable, whose numbers take the place of these. The number of
/// successes belongs to it, as inputs grow with the share of them that is done.
inline rc::detail::TestParams explored_parameters() {
  static const rc::detail::TestParams once = [] {
    rc::detail::Configuration drawn;
    drawn.testParams.seed = std::random_device()();
    drawn.testParams.maxSuccess = 100;
    const char* given = std::getenv("RC_PARAMS");
    const auto all = rc::detail::configFromString(given == nullptr ? "" : given, drawn);
    // RapidCheck reads it as well, and prints the seed that it finds.
    setenv("RC_PARAMS", rc::detail::configToString(all).c_str(), 1);
    return all.testParams;
  }();
  return once;
}

/// Checks a property, which asserts by RC_ASSERT, on random inputs: on the same 300 in every run, then on others, drawn
/// anew for each run. The line above a result says how to repeat the drawn ones. To explore more of them, run a test
/// with RC_PARAMS="max_success=10000".
template <class Property>
bool check_property(const std::string& sentence, const Property& property) {
  rc::detail::TestParams fixed;
  fixed.seed = 2004;
  fixed.maxSuccess = 300;
  const rc::detail::TestParams explored = explored_parameters();
  const std::string repeat = "explored inputs, repeated by RC_PARAMS=\"seed=" + std::to_string(explored.seed) +
                             " max_success=" + std::to_string(explored.maxSuccess) + "\"";
  // RapidCheck's own listener says how to repeat a single input, which nothing here would read.
  rc::detail::TestListenerAdapter silent;
  for (const auto& [parameters, inputs] :
       {std::pair(fixed, std::string("inputs of every run")), std::pair(explored, repeat)}) {
    const auto result =
        rc::detail::checkTestable(property, rc::detail::TestMetadata{sentence, sentence}, parameters, silent);
    std::cerr << "- " << sentence << " (" << inputs << ")\n";
    rc::detail::printResultMessage(result, std::cerr);
    std::cerr << std::endl;
    if (!result.template is<rc::detail::SuccessResult>()) {
      return false;
    }
  }
  return true;
}

}  // namespace chainmail::test
