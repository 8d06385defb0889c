#pragma once

#include <QObject>
#include <QString>

#include "document/change.h"

namespace chainmail {

/// The files of a document.
class DocumentFiles : public QObject {
  Q_OBJECT

 public:
  explicit DocumentFiles(const Contents& contents) : contents_(contents) {}

  /// The file of this session; empty if it has none yet.
  const QString& session() const { return session_; }
  /// Returns the mesh file that the object was opened from; empty if there is none.
  const QString& mesh() const { return contents_.object->file; }
  void setSession(const QString& file);
  /// Exchanges the file of the session with `file`, which an undo step keeps.
  void exchangeSession(QString& file);
  /// The object was opened from this mesh file.
  void setMesh(const QString& file);

 signals:
  void sessionChanged();
  void meshChanged();

 private:
  const Contents& contents_;
  QString session_;
};

}  // namespace chainmail
