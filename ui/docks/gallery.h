#pragma once

#include <QScrollArea>

class QGridLayout;
class QLabel;

namespace chainmail {

/// The samples by their thumbnails; a click chooses one.
class Gallery : public QScrollArea {
  Q_OBJECT

 public:
  /// Of those that lie in this folder, which may be none.
  explicit Gallery(const QString& folder);

 signals:
  void chosen(const QString& path);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void fill();

  QString folder_;
  QGridLayout* grid_;
  bool filled_ = false;
};

}  // namespace chainmail
