#pragma once

#include <QString>
#include <QStringList>
#include <QTemporaryDir>
#include <memory>

namespace chainmail {

class MainWindow;

/// Sets what must be set before the application object exists: OpenGL, shared contexts, settings.
void prepareApplication();

/// From now on, the window keeps its unsaved work, with the last drag, when a signal ends the program or the display is
/// lost.
void keepWorkAtTheEnd(MainWindow& window);

/// Sets icon, style and palette. Call it after the application object is made.
void styleApplication();

/// Returns the reason why the workbench cannot draw on this platform; empty if it can.
QString whyNoWindow();

/// Keeps damaged settings from ending or delaying every start. Settings that Qt must not read are set aside. So are all
/// settings if two starts in a row ended before their first frame: this one then begins with defaults. Make it before
/// anything reads the settings; it lives as long as the program, whose regular end also counts as a start that worked.
class StartGuard {
 public:
  StartGuard();
  ~StartGuard();
  StartGuard(const StartGuard&) = delete;
  StartGuard& operator=(const StartGuard&) = delete;

  /// What the user should know.
  const QStringList& notes() const { return notes_; }
  /// The window is on the screen.
  void succeed();

 private:
  void check(const QString& path);
  void countStarts();
  void dropOldSettings();

  std::unique_ptr<QTemporaryDir> spare_;  // has the settings if the user's cannot be used
  QStringList notes_;
  bool isDone_ = false;
};

}  // namespace chainmail
