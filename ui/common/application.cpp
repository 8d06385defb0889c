#include "common/application.h"

#include <QEvent>
#include <mutex>
#include <new>
#include <utility>

#include "common/held_memory.h"
#include "mesh/failure.h"

namespace chainmail {
namespace {

constexpr std::size_t reserveBytes = 16 * 1024 * 1024;
constexpr qint64 quietMilliseconds = 10'000;  // a failure in every paint must not be reported in every paint

/// The reserve of the process. C++ calls the handler of failed allocations without arguments, so it must find it here.
struct Reserve {
  std::mutex mutex;
  HeldMemory memory;
};

Reserve& reserve() {
  static Reserve one;
  return one;
}

/// Called by operator new when it finds no memory. Gives the reserve away once; then allocations fail.
void giveReserve() {
  const std::lock_guard lock(reserve().mutex);
  if (reserve().memory.bytes() == 0) {
    throw std::bad_alloc();
  }
  reserve().memory.release();
}

void fillReserve() {
  const std::lock_guard lock(reserve().mutex);
  reserve().memory.hold(reserveBytes);
}

}  // namespace

Application::Application(int& argc, char** argv) : QApplication(argc, argv) {
  fillReserve();
  std::set_new_handler(&giveReserve);
}

Application::~Application() { std::set_new_handler(nullptr); }

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
    fillReserve();
  } catch (...) {
    failure_ = std::move(sentence);  // after the next event
  }
}

}  // namespace chainmail
