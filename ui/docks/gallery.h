#pragma once

#include <QFrame>

class QGridLayout;

namespace chainmail {

/// A popover with thumbnails of the samples; a click opens one.
class Gallery : public QFrame {
  Q_OBJECT

 public:
  /// Shows the samples in `folder`. An empty string means that there is no such folder.
  explicit Gallery(const QString& folder, QWidget* parent = nullptr);

  /// Opens below a button, or where there is room on its screen.
  void openBelow(const QWidget& button);

 signals:
  void chosen(const QString& path);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  void fill();

  QString folder_;
  QGridLayout* grid_;
};

}  // namespace chainmail
