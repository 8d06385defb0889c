#include "common/application.h"

#include <unistd.h>

#include <QEvent>
#include <array>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <string_view>
#include <utility>

#include "mesh/error.h"

namespace chainmail {
namespace {

constexpr qint64 quietMilliseconds = 10'000;  // a failure in every paint must not be reported in every paint

constexpr std::array deadlySignals{SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV};
constexpr std::size_t stackBytes = 64 * 1024;  // a signal may come because the stack is full

/// Calls only functions that a handler of signals may call.
void sayLastWords() {
  constexpr std::string_view words =
      "workbench: an unexpected error ends the program; start it again, and it offers your unsaved work\n";
  const auto written = ::write(STDERR_FILENO, words.data(), words.size());
  static_cast<void>(written);
}

/// The default action of the signal, which ends the program, follows when this returns.
void receiveSignal(int /*signal*/) { sayLastWords(); }

[[noreturn]] void terminate() { std::abort(); }  // its signal says the words

}  // namespace

Application* Application::get() { return qobject_cast<Application*>(QCoreApplication::instance()); }

bool Application::notify(QObject* receiver, QEvent* event) {
  const bool paints = event->type() == QEvent::Paint;  // the event may not exist any more afterwards
  paints_ += paints ? 1 : 0;
  bool isHandled = true;
  try {
    isHandled = QApplication::notify(receiver, event);
  } catch (...) {
    noteFailure();
  }
  paints_ -= paints ? 1 : 0;
  if (!failure_.empty() && paints_ == 0) {
    isOfPaint_ ? reportLater() : reportFailure();
  }
  return isHandled;
}

void Application::noteFailure() noexcept {
  if (Application* application = get()) {
    application->failure_ = failure_sentence("Action not completed");
    application->isOfPaint_ = application->paints_ > 0;
  }
}

/// A report shows a bar, which resizes the views. Qt must not meet that between the paint of a view and the moment when
/// it shows what was painted: it would use the memory of the picture that the view had before.
void Application::reportLater() noexcept {
  try {
    if (!reportWaits_) {
      QMetaObject::invokeMethod(this, &Application::reportWaiting, Qt::QueuedConnection);
      reportWaits_ = true;
    }
  } catch (...) {  // it is tried again after the next event
  }
}

void Application::reportWaiting() {
  reportWaits_ = false;
  if (!failure_.empty()) {
    reportFailure();
  }
}

void Application::reportFailure() noexcept {
  std::string sentence = std::exchange(failure_, {});  // first, because reporting may fail, too
  try {
    if (isOfPaint_ && sentence == lastOfPaint_ && since_.isValid() && since_.elapsed() < quietMilliseconds) {
      return;
    }
    emit failed(QString::fromStdString(sentence));
    if (isOfPaint_) {
      lastOfPaint_ = std::move(sentence);
      since_.start();
    }
  } catch (...) {
    failure_ = std::move(sentence);  // after the next event
  }
}

void prepareLastWords() {
  static std::array<char, stackBytes> stack;
  stack_t own{};
  own.ss_sp = stack.data();
  own.ss_size = stack.size();
  ::sigaltstack(&own, nullptr);
  for (const int signal : deadlySignals) {
    struct sigaction present {};
    if (::sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_DFL) {
      struct sigaction action {};
      action.sa_handler = &receiveSignal;
      action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND);
      ::sigaction(signal, &action, nullptr);
    }
  }
  std::set_terminate(&terminate);
}

}  // namespace chainmail
