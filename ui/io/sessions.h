#pragma once

#include <QObject>

#include "common/jobs.h"
#include "document/document.h"
#include "files/session/session.h"
#include "io/look_access.h"

namespace chainmail {

class Autosave;
class RecoveryBar;

/// Sessions of a window: opened and saved in the background, kept safe while there is something to lose, and offered
/// at the next start.
class Sessions : public QObject {
  Q_OBJECT

 public:
  Sessions(Document& document, Jobs& jobs, LookAccess look, QObject* parent);
  ~Sessions() override;

  /// Opens one in the background, as one step of undo or as the window's first object.
  void openPath(const QString& path, bool first);
  void savePath(const QString& path);

  /// Where what a crash left is offered.
  RecoveryBar& recoveryBar() { return *recovery_; }
  /// Begins to keep the window's work safe, and offers what a crash has left. Tests do without.
  void protect();
  /// The window is closed by the user: what is unsaved is offered at the next start.
  void keep();
  /// Work is kept safe no longer.
  void close();

 signals:
  void failed(const QString& sentence);
  void saved(const QString& path);
  void opened(const QString& path);

 private:
  void show(const std::shared_ptr<const Session>& session, const QString& path, bool first);
  void restore(const QString& path);

  Document& document_;
  Jobs& jobs_;
  const LookAccess look_;
  std::uint64_t steps_ = 0;  // of undo, redo and doing
  RecoveryBar* recovery_;
  std::unique_ptr<Autosave> autosave_;
};

}  // namespace chainmail
