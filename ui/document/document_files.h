#pragma once

#include <QObject>
#include <QString>

namespace chainmail {

/// The file of a document.
class DocumentFiles : public QObject {
  Q_OBJECT

 public:
  /// The file of this session; empty if it has none yet.
  const QString& session() const { return session_; }
  void setSession(const QString& file);
  /// Exchanges the file of the session with `file`, which an undo step keeps.
  void exchangeSession(QString& file);

 signals:
  void sessionChanged();

 private:
  QString session_;
};

}  // namespace chainmail
