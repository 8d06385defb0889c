#pragma once

#include <set>
#include <vector>

#include "document/document.h"
#include "panels/tool.h"

namespace chainmail {

/// Draws a stroke and highlights the links that it crosses. Releasing the button cuts the object in all panels: it
/// splits the faces along the stroke, or, where there are none, cuts the links. The stroke cuts through the whole
/// object, or only its front layer.
class CutTool : public Tool {
 public:
  explicit CutTool(Document& document) : document_(document) {}

  /// True if strokes cut only what is visible.
  bool frontOnly() const { return frontOnly_; }
  void setFrontOnly(bool frontOnly) { frontOnly_ = frontOnly; }
  /// True if strokes split faces where faces are drawn; false if they always cut links.
  bool splits() const { return splits_; }
  void setSplits(bool splits) { splits_ = splits; }

  QString name() const override { return QStringLiteral("Cut"); }
  QString hint() const override;
  QCursor cursor() const override { return Qt::CrossCursor; }

  void hover(View& view, QPointF position) override;
  void press(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void move(View& view, QPointF position, Qt::KeyboardModifiers modifiers) override;
  void release(View& view, QPointF position) override;
  bool busy() const override { return at_ != nullptr; }
  /// During a stroke, the view does not zoom: the stroke is a line on the screen.
  bool wheel(View& /*view*/, QPointF /*position*/, double /*notches*/) override { return busy(); }
  void cancel() override;
  std::span<const QPointF> stroke(const View& view) const override;
  std::span<const QVector3D> ribbon(const View& view) const override;

 private:
  void add(const View& view, QPointF position);
  void cut(const View& view, const std::vector<LinkId>& links, const std::vector<QPointF>& stroke);

  Document& document_;
  bool frontOnly_ = false;
  bool splits_ = false;
  const View* at_ = nullptr;  // the view of the stroke; null if there is none
  std::vector<QPointF> stroke_;
  std::vector<QVector3D> ribbon_;
  std::set<LinkId> crossed_;  // links that the stroke has crossed so far
};

}  // namespace chainmail
