#pragma once

#include <QDockWidget>

class QAction;
class QActionGroup;

namespace chainmail {

/// The tools, one of which is what the left mouse button does.
class ToolsDock : public QDockWidget {
  Q_OBJECT

 public:
  explicit ToolsDock(const QActionGroup& tools);
};

}  // namespace chainmail
