#pragma once

#include <QApplication>
#include <QElapsedTimer>
#include <string>

namespace chainmail {

/// The application. An exception that leaves a slot, a timer or the handler of an event does not end the program: it
/// becomes one sentence, and the event loop goes on.
///
/// Code that Qt calls in the middle of its own work, such as painting with OpenGL, must not let an exception through
/// Qt: it runs in guarded(). So do listeners in the middle of a change of the document.
class Application : public QApplication {
  Q_OBJECT

 public:
  using QApplication::QApplication;

  /// Returns the application; null if it is of another class.
  static Application* get();

  bool notify(QObject* receiver, QEvent* event) override;

  /// Calls a function of the GUI thread. What it throws is reported soon, when Qt is not painting.
  template <class Call>
  static void guarded(const Call& call) noexcept {
    try {
      call();
    } catch (...) {
      noteFailure();
    }
  }

 signals:
  /// Something failed; `sentence` says what happened and what to do. While painting fails again and again, the same
  /// sentence comes only every few seconds.
  void failed(const QString& sentence);

 private:
  /// Takes note of the exception that is being handled, unless the application is of another class.
  static void noteFailure() noexcept;
  void reportFailure() noexcept;
  void reportLater() noexcept;
  void reportWaiting();

  std::string failure_;       // not reported yet; empty: none
  bool isOfPaint_ = false;    // true if it failed while Qt was painting
  std::string lastOfPaint_;   // the last one of these that was reported
  QElapsedTimer since_;       // runs since then
  bool reportWaits_ = false;  // true if reportWaiting() is posted
  int paints_ = 0;            // number of paint events that are being handled
};

/// From now on, a program that has to end at once says so in one sentence on standard error: where the unsaved work is.
/// This is for what nothing can catch: a library that crashes when memory runs out, or an exception in a destructor.
/// Writes no file: automatic saving has written the work some seconds before. Handlers that others have set stay.
void prepareLastWords();

}  // namespace chainmail
