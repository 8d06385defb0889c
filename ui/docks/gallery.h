#pragma once

#include <QScrollArea>

class QGridLayout;
class QLabel;

namespace chainmail {

/// Thumbnails of the samples; a click opens one.
class Gallery : public QScrollArea {
  Q_OBJECT

 public:
  /// Shows the samples in this folder. An empty string: there is no folder.
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
