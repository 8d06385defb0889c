#include "bench/contest.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace chainmail::bench {
namespace {

constexpr int repetitions = 7;

/// Keeps the time of each repetition, by contestant (ms a pass).
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

/// Google Benchmark takes its settings as arguments, once.
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

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times.empty() ? 0 : times[times.size() / 2];
}

}  // namespace

std::vector<Run> run(const Contest& contest) {
  initialize();
  struct Count {
    std::uint64_t moved = 0, passes = 0;
  };
  std::vector<Count> counts(contest.contestants.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Contestant& one = contest.contestants[i];
    benchmark::RegisterBenchmark(one.algorithm.c_str(),
                                 [&one, &count = counts[i]](benchmark::State& state) {
                                   for (auto _ : state) {
                                     count.moved += one.pass();
                                     ++count.passes;
                                   }
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Iterations(contest.passes)
        ->Repetitions(repetitions);
  }
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector, ".");
  benchmark::ClearRegisteredBenchmarks();

  std::vector<Run> runs;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string& algorithm = contest.contestants[i].algorithm;
    runs.push_back({contest.name, contest.mesh, algorithm, contest.elements,
                    double(counts[i].moved) / double(std::max<std::uint64_t>(1, counts[i].passes)),
                    median(collector.times[algorithm])});
    const Run& one = runs.back();
    std::printf("%-18s %-18s %-24s %9llu %11.1f %10.4f ms %8.2f ns\n", one.name.c_str(), one.mesh.c_str(),
                one.algorithm.c_str(), static_cast<unsigned long long>(one.elements), one.moved, one.ms,
                one.ns_per_moved());
    std::fflush(stdout);
  }
  return runs;
}

const Run& of(const std::vector<Run>& runs, const std::string& algorithm) {
  const auto found = std::find_if(runs.begin(), runs.end(), [&](auto& one) { return one.algorithm == algorithm; });
  if (found == runs.end()) {
    throw std::logic_error("no run of " + algorithm);
  }
  return *found;
}

}  // namespace chainmail::bench
