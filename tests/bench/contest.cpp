#include "bench/contest.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace chainmail::bench {
namespace {

// Per process; tests/run bench starts several processes.
constexpr int repetitions = 3;

/// Stores the time of each repetition, by contestant (ms per pass).
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& /*context*/) override { return true; }
  void ReportRuns(const std::vector<Run>& report) override {
    for (const Run& run : report) {
      if (run.run_type == Run::RT_Iteration) {
        times[run.run_name.function_name].push_back(run.GetAdjustedRealTime());
      }
    }
  }

  std::map<std::string, std::vector<double>> times;
};

/// Passes the settings to Google Benchmark, which takes them once, as arguments.
void initialize() {
  static const bool done = [] {
    std::string program = "bench", interleave = "--benchmark_enable_random_interleaving=true";
    std::vector<char*> arguments{program.data(), interleave.data(), nullptr};
    int count = 2;
    benchmark::Initialize(&count, arguments.data());
    return true;
  }();
  benchmark::DoNotOptimize(done);
}

std::string name(const Contestant& one) { return one.drag + "/" + one.mesh + "/" + one.algorithm; }

struct Count {
  std::uint64_t moved = 0, passes = 0;
};

void enter(const Contestant& one, Count& count) {
  benchmark::RegisterBenchmark(name(one).c_str(),
                               [&](benchmark::State& state) {
                                 for (auto _ : state) {
                                   count.moved += one.pass();
                                   ++count.passes;
                                 }
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->Iterations(one.passes)
      ->Repetitions(repetitions);
}

void say(const Run& one) {
  std::printf("%-17s %-18s %-29s %8llu %10.1f %10.4f ms %8.2f ns\n", one.drag.c_str(), one.mesh.c_str(),
              one.algorithm.c_str(), static_cast<unsigned long long>(one.elements), one.moved, one.ms,
              one.ns_per_moved());
  std::fflush(stdout);
}

}  // namespace

std::vector<Run> run(const std::vector<Contestant>& contest) {
  initialize();
  std::vector<Count> counts(contest.size());
  for (std::size_t i = 0; i < contest.size(); ++i) {
    enter(contest[i], counts[i]);
  }
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, ".");
  benchmark::ClearRegisteredBenchmarks();

  std::vector<Run> runs;
  for (std::size_t i = 0; i < contest.size(); ++i) {
    const Contestant& one = contest[i];
    runs.push_back({one.drag, one.mesh, one.algorithm, one.elements, double(counts[i].moved) / double(counts[i].passes),
                    median(collector.times.at(name(one)))});
    say(runs.back());
  }
  return runs;
}

const Run& of(const std::vector<Run>& runs, const std::string& algorithm, const std::string& mesh) {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](const Run& one) {
    return one.algorithm == algorithm && (mesh.empty() || one.mesh == mesh);
  });
  if (found == runs.end()) {
    throw std::logic_error("no run of " + algorithm + " " + mesh);
  }
  return *found;
}

}  // namespace chainmail::bench
