#pragma once

#include <QElapsedTimer>
#include <QString>
#include <cstdlib>
#include <ctime>
#include <thread>

namespace chainmail::test {

/// Measures whether something was done within a time that is promised to people. On a machine that is busy with other
/// programs, which take turns, it compares the processor time of this process.
/// A shared processor also computes more slowly.
class FairTimer {
 public:
  FairTimer() { timer_.start(); }

  bool within(qint64 milliseconds) const {
    return timer_.elapsed() < milliseconds || (machineIsBusy() && processor() < slower * double(milliseconds));
  }
  QString inWords() const {
    return QStringLiteral("it took %1 ms, %2 ms of them on a processor").arg(timer_.elapsed()).arg(processor());
  }

 private:
  static constexpr double slower = 3;  // a processor that others share, at most

  static bool machineIsBusy() {
    double load = 0;
    return getloadavg(&load, 1) == 1 && load > std::thread::hardware_concurrency() + 0.5;
  }
  double processor() const { return 1000.0 * double(std::clock() - clock_) / CLOCKS_PER_SEC; }

  QElapsedTimer timer_;
  std::clock_t clock_ = std::clock();  // of all threads of this process
};

}  // namespace chainmail::test
