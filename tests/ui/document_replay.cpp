// Replay of a document: the recorded commands lead to the same object, bit by bit, and a drag can continue from any of
// them.

#include <QTest>

#include "document/edits.h"
#include "document_bench.h"
#include "mesh/generate.h"
#include "program.h"

namespace chainmail::test_document_replay {

namespace {

using Shapes = std::vector<std::vector<float>>;

/// Makes two drags with a cut and pins in between. Returns false if the solvers do not settle.
bool work(Document& document) {
  if (!has_settled(document) || !drag_and_release(document, 31, {1.7, 2.1, 0})) {
    return false;
  }
  edits::cut(document, {3, 4, 40});
  edits::setPinned(document, {0}, true);
  edits::setSoftness(document, {0.9, 1.1, 0.05}, QStringLiteral("stiffer"));
  return drag_and_release(document, 62, {0.9, 1.4, 0});
}

bool goes_to(Document& document, std::size_t position) {
  document.moves().goTo(position);
  return has_settled(document) && document.moves().history().position() == position;
}

}  // namespace

class DocumentReplayTest : public QObject {
  Q_OBJECT

 private slots:
  void a_replay_gives_identical_bits();
  void a_drag_continues_from_an_earlier_position();
  void a_move_goes_to_idle_solvers_at_once();

 private:
  const MeshPointer mesh_ = generate({MeshKind::grid, {9, 7, 1}, 1, {}});
};

void DocumentReplayTest::a_replay_gives_identical_bits() {
  Document document(mesh_, QStringLiteral("sheet"));
  QVERIFY(work(document));
  const Shapes live = shapes_of(document);
  const MoveHistory& history = document.moves().history();
  const std::size_t length = history.length();
  QCOMPARE(history.position(), length);
  QVERIFY(goes_to(document, history.start()));
  const std::vector<float> rest(mesh_->rest.begin(), mesh_->rest.end());
  QVERIFY(shapes_of(document) == (Shapes{rest, rest}));
  QCOMPARE(document.cuts().count(), 0U);
  QVERIFY(document.pins().empty());
  QVERIFY(*document.wholeSoftness() == standard_softness());  // as the object was when it was new
  QCOMPARE(history.length(), length);
  QVERIFY(goes_to(document, length));
  QVERIFY(shapes_of(document) == live);
  QCOMPARE(document.cuts().count(), 3U);
  QCOMPARE(document.pins(), std::vector<ElementId>{0});
}

void DocumentReplayTest::a_drag_continues_from_an_earlier_position() {
  Document document(mesh_, QStringLiteral("sheet"));
  QVERIFY(work(document));
  const MoveHistory& history = document.moves().history();
  QVERIFY(goes_to(document, history.start()));
  QVERIFY(goes_to(document, 2));  // after the first move of the first drag
  QVERIFY(history.position() < history.length());
  QVERIFY(drag_and_release(document, 5, {-0.8, -1.1, 0}));
  QCOMPARE(history.position(), history.length());
  const Shapes live = shapes_of(document);
  QVERIFY(goes_to(document, history.start()));
  QVERIFY(shapes_of(document) != live);
  QVERIFY(goes_to(document, history.length()));
  QVERIFY(shapes_of(document) == live);
}

void DocumentReplayTest::a_move_goes_to_idle_solvers_at_once() {
  Document document(mesh_, QStringLiteral("sheet"));
  const MoveHistory& history = document.moves().history();
  document.handle().grab(31);
  const auto finish = [&document] {
    QVERIFY(QTest::qWaitFor([&document] { return document.solvers().idle(); }, longest_wait));
  };
  for (int i = 1; i <= 5; ++i) {
    finish();
    const std::size_t recorded = history.length();
    document.handle().drag(Point(4, 3 + 0.1 * i, 0));
    QCOMPARE(history.length(), recorded + 1);
  }
  // While a solver is busy, only the newest move waits.
  finish();
  std::promise<void> busy;
  document.solvers().ask(1, [end = busy.get_future().share()](const Simulation&) { end.wait(); });
  const std::size_t recorded = history.length();
  for (int i = 1; i <= 200; ++i) {
    document.handle().drag(Point(4, 4 + 0.01 * i, 0));
  }
  QCOMPARE(history.length(), recorded);
  busy.set_value();
  QVERIFY(has_settled(document));
  QCOMPARE(position_of(document, 1, 31), Point(4, 6, 0));
  QCOMPARE(history.length(), recorded + 1);
  document.handle().release();
}

CHAINMAIL_TEST(DocumentReplayTest)

}  // namespace chainmail::test_document_replay

#include "document_replay.moc"
