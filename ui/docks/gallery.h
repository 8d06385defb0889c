#pragma once

#include <QScrollArea>

class QGridLayout;
class QLabel;

namespace chainmail {

/// Thumbnails of the samples; a click opens one.
class Gallery : public QScrollArea {
  Q_OBJECT

 public:
  /// Shows the samples in `folder`. An empty string means that there is no such folder.
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
