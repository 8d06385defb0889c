#pragma once

#include "document/edits.h"
#include "document/session_draft.h"
#include "window.h"
#include "window/window_layout.h"

namespace chainmail {

inline MeshPointer cloth() { return generate({MeshKind::cloth, {12, 9, 1}, 0.7, {}}); }

inline void drag(Document& document, ElementId element, const Point& by) {
  document.handle().grab(element);
  document.handle().drag(document.mesh()->rest_position(element) + by);
  document.handle().release();
}

/// Changes everything that a session stores.
inline void changeEverything(Workbench& bench) {
  Document& document = bench.document();
  edits::setAlgorithm(document, 0, Algorithm::exact);
  edits::setAlgorithm(document, 1, Algorithm::spiral);
  edits::setPinned(document, {0, 11}, true);
  edits::cut(document, {3, 40});
  edits::setSoftness(document, {0.7, 1.3, 0.15}, QStringLiteral("softness"));
  edits::setSoftnessOf(document, {5, 6}, LinkSoftness{1, 1, 0});
  edits::setRelaxation(document, {false, 0.5, RelaxationScheme::link});
  edits::setElastic(document, {{2, 0.4}, {3, 4, 5}}, QStringLiteral("material"));
  drag(document, 50, {1.3, -0.9, 0});
  drag(document, 100, {-0.1, 1.0 / 3, 0});
  bench.settle();
}

inline Session sessionOf(Workbench& bench) {
  return SessionDraft(bench.document(), layoutOf(bench.window)).finished({});
}

inline void compare(const Session& again, const Session& before) {
  QCOMPARE(again.name, before.name);
  QVERIFY(again.mesh->rest == before.mesh->rest && again.mesh->links == before.mesh->links);
  QVERIFY(again.mesh->triangles == before.mesh->triangles && again.mesh->neighbours == before.mesh->neighbours);
  QCOMPARE(again.cuts, before.cuts);
  QCOMPARE(again.pins, before.pins);
  QVERIFY(*again.softness == *before.softness);
  QVERIFY(again.relaxation == before.relaxation);
  QVERIFY(again.elastic == before.elastic);
  QCOMPARE(again.panels.size(), before.panels.size());
  for (std::size_t panel = 0; panel < again.panels.size(); ++panel) {
    QVERIFY(again.panels[panel].algorithm == before.panels[panel].algorithm);
    QVERIFY(!again.panels[panel].positions.is_at_rest());
    QVERIFY(again.panels[panel].positions == before.panels[panel].positions);
  }
}

}  // namespace chainmail
