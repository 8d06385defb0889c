#pragma once

#include <QFrame>
#include <QLabel>

namespace chainmail {

/// Says that another program has changed the file of the session, and offers to open it again.
class ReloadBar : public QFrame {
  Q_OBJECT

 public:
  ReloadBar();

  void offer(const QString& path);

 signals:
  void reloadRequested(const QString& path);

 private:
  QString path_;
  QLabel* text_;
};

}  // namespace chainmail
