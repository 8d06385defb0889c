// A document and its solvers have the same object, whatever comes together.

#include <QSignalSpy>
#include <QTest>
#include <future>
#include <sstream>

#include "core/families.h"
#include "document/document.h"
#include "document/edits.h"
#include "document/propagation.h"
#include "document/session_draft.h"
#include "mesh/generate.h"
#include "mesh/progress.h"
#include "program.h"

namespace chainmail::test_document_changes {

using namespace chainmail::test;

namespace {

bool is_idle(Document& document) {
  return QTest::qWaitFor([&document] { return document.solvers().idle(); }, 60'000);
}

/// Writes the session of a document, and reads it as the next start of the program does.
std::shared_ptr<const Session> session_of(Document& document) {
  std::ostringstream text;
  write_session(text, SessionDraft(document, "{}").finished({}));
  return std::make_shared<const Session>(parse_session(text.str(), "test.chainmail"));
}

std::vector<ElementId> pins_of_solver(Document& document, int panel) {
  std::promise<std::vector<ElementId>> pins;
  document.solvers().ask(panel, [&pins](const Simulation& now) {
    pins.set_value({now.body().pins().begin(), now.body().pins().end()});
  });
  return pins.get_future().get();
}

SplitPointer split_of(const MeshPointer& mesh) {
  const auto [a, b, c] = mesh->triangles[3];
  const ElementId p = mesh->element_count();
  std::array corners{a, b, c};
  std::ranges::sort(corners);
  return make_split(mesh, {{{corners, {0.25, 0.5}}}, {3}, {{a, b, p}, {b, c, p}, {c, a, p}}, {}, {}});
}

}  // namespace

class DocumentChangesTest : public QObject {
  Q_OBJECT

 private slots:
  void the_session_after_a_refused_drag_opens();
  void each_refused_grab_is_said();
  void a_change_ends_the_drag_in_the_solvers();
  void a_change_after_a_session_saved_while_dragging_can_be_saved();
  void a_drag_names_the_elements_that_move();
  void a_split_in_a_lesson_keeps_the_settings_before_it();
  void undo_makes_the_mesh_of_a_split_again();
  void a_panel_may_be_removed_while_saving();
  void a_panel_that_is_added_shows_its_passes();

 private:
  const MeshPointer mesh_ = jittered_triangles(5, 4, 2);
};

void DocumentChangesTest::the_session_after_a_refused_drag_opens() {
  Document document(mesh_, QStringLiteral("sheet"));
  edits::setPinned(document, {3}, true);
  for (const ElementId element : {3u, 7u}) {
    document.handle().grab(element);
    document.handle().dragBy(Point(0.5, 1, 0));
    document.handle().release();
    QVERIFY(is_idle(document));
  }
  const auto session = session_of(document);
  Document next(session->mesh, QStringLiteral("next"));
  edits::restore(next, session, {}, QStringLiteral("open"));
  QCOMPARE(next.pins(), std::vector<ElementId>{3});
  QCOMPARE(next.moves().lastDrag().size(), std::size_t{2});  // the grab and the drag of element 7
}

void DocumentChangesTest::each_refused_grab_is_said() {
  Document document(mesh_, QStringLiteral("sheet"));
  const QSignalSpy refused(&document, &Document::refused);
  edits::setPinned(document, {3}, true);
  for (int attempt = 1; attempt <= 2; ++attempt) {
    document.handle().grab(3);
    QTRY_COMPARE(refused.size(), qsizetype(attempt * document.panels()));
  }
}

void DocumentChangesTest::a_change_ends_the_drag_in_the_solvers() {
  Document document(mesh_, QStringLiteral("sheet"));
  const QSignalSpy refused(&document, &Document::refused);
  document.handle().grab(7);
  document.handle().dragBy(Point(0.5, 1, 0));
  edits::setPinned(document, {7}, true);
  QVERIFY(is_idle(document));
  for (int panel = 0; panel < document.panels(); ++panel) {
    QCOMPARE(pins_of_solver(document, panel), document.pins());
  }
  QVERIFY(refused.isEmpty());
}

void DocumentChangesTest::a_change_after_a_session_saved_while_dragging_can_be_saved() {
  Document document(mesh_, QStringLiteral("sheet"));
  document.handle().grab(7);
  document.handle().dragBy(Point(0.5, 1, 0));
  QVERIFY(is_idle(document));
  Document next(mesh_, QStringLiteral("next"));
  const QSignalSpy refused(&next, &Document::refused);
  edits::restore(next, session_of(document), {}, QStringLiteral("open"));
  edits::setPinned(next, {7}, true);
  QVERIFY(is_idle(next));
  QCOMPARE(refused.size(), qsizetype{0});
  const auto session = session_of(next);
  QCOMPARE(session->pins, std::vector<ElementId>{7});
  // The same after a replay that ends within the drag.
  document.handle().release();
  document.moves().goTo(2);
  edits::setPinned(document, {7}, true);
  QVERIFY(is_idle(document));
  QCOMPARE(session_of(document)->pins, std::vector<ElementId>{7});
}

/// Pinned elements stay behind, so they do not count.
void DocumentChangesTest::a_drag_names_the_elements_that_move() {
  Document document(mesh_, QStringLiteral("sheet"));
  edits::setPinned(document, {7, 8}, true);
  for (const auto& [held, text] : {std::pair(std::vector<ElementId>{6, 7, 8, 11}, "drag of 2 elements"),
                                   {std::vector<ElementId>{7, 11}, "drag of element 11"}}) {
    document.handle().grab(held);
    document.handle().dragBy(Point(0.5, 1, 0));
    document.handle().release();
    QCOMPARE(document.undoStack().undoText(), QLatin1String(text));
  }
}

void DocumentChangesTest::a_split_in_a_lesson_keeps_the_settings_before_it() {
  Document document(mesh_, QStringLiteral("sheet"));
  document.handle().grab(7);
  document.handle().dragBy(Point(0.5, 1, 0));
  document.handle().release();
  Session lesson = SessionDraft(document, "{}").finished({});
  LessonStep step;
  step.title = "step";
  step.until = lesson.moves_done;
  lesson.lesson = {"lesson", {step}};
  const LinkSoftness own{0.5, 1.5, 0.3};
  edits::setSoftness(document, own, QStringLiteral("softness"));
  const commands::SetRelaxation relaxation{.step = 0.25, .scheme = RelaxationScheme::link};
  edits::setRelaxation(document, relaxation);
  ElasticOptions elastic;
  elastic.material.poisson = 0.1;
  edits::setElastic(document, elastic, QStringLiteral("elastic"));
  edits::restore(document, std::make_shared<const Session>(lesson), {}, QStringLiteral("open"));
  QVERIFY(document.softness() == LinkSoftness() && document.relaxation() != relaxation);
  QVERIFY(document.elastic() != elastic);
  edits::split(document, split_of(document.mesh()));
  edits::replaceMesh(document, mesh_, QStringLiteral("sheet"), QStringLiteral("open"));
  QVERIFY(document.softness() == own);
  QVERIFY(document.relaxation() == relaxation && document.elastic() == elastic);
}

/// Undo steps and solvers keep what splits changed, not their meshes.
void DocumentChangesTest::undo_makes_the_mesh_of_a_split_again() {
  Document document(mesh_, QStringLiteral("sheet"));
  edits::split(document, split_of(document.mesh()));
  const LinkId link = document.mesh()->link_count() - 1;
  edits::cut(document, {link});
  document.handle().grab(7);
  document.handle().dragBy(Point(0.5, 1, 0));
  document.handle().release();
  const std::shared_ptr<const Session> before = session_of(document);
  const std::weak_ptr<const Mesh> divided = document.mesh();
  edits::replaceMesh(document, generate({MeshKind::grid, {3, 3, 1}, 1, {}}), QStringLiteral("other"),
                     QStringLiteral("open"));
  QVERIFY(is_idle(document));
  QTRY_VERIFY(divided.expired());
  document.undoStack().undo();
  QVERIFY(is_idle(document));
  const std::shared_ptr<const Session> after = session_of(document);
  QCOMPARE(after->mesh->links, before->mesh->links);
  QCOMPARE(after->cuts, std::vector<LinkId>{link});
  QVERIFY(after->panels.front().positions == before->panels.front().positions);
  QVERIFY(document.cuts().is_cut(link));
  QCOMPARE(document.parts(), 1U);
  document.undoStack().undo();
  document.undoStack().undo();
  QCOMPARE(document.mesh()->element_count(), mesh_->element_count() + 1);
  document.undoStack().undo();
  QCOMPARE(document.mesh(), mesh_);
}

/// The draft shares the solvers, and the panel is removed before its solver has reported its positions.
void DocumentChangesTest::a_panel_may_be_removed_while_saving() {
  Document document(mesh_, QStringLiteral("sheet"));
  document.addPanel();
  edits::replaceMesh(document, generate({MeshKind::grid, {400, 400, 1}, 1, {}}), QStringLiteral("large"),
                     QStringLiteral("build"));
  const SessionDraft draft(document, {});
  document.removePanel();
  const Progress job = Progress::watched();
  const Session session = draft.finished(job);
  QVERIFY(session.panels.size() == 2 || session.panels.size() == 3);
  QCOMPARE(session.mesh, document.mesh());
}

/// The Propagation dock is open before the panel comes.
void DocumentChangesTest::a_panel_that_is_added_shows_its_passes() {
  Document document(mesh_, QStringLiteral("sheet"));
  Propagation propagation(document);
  propagation.setOpen(true);
  propagation.setShown(true);
  document.addPanel();
  document.handle().grab(7);
  document.handle().dragBy(Point(0.5, 1, 0));
  document.handle().release();
  for (int panel = 0; panel < 3; ++panel) {
    QTRY_VERIFY(propagation.player(panel) != nullptr);
    QVERIFY(propagation.player(panel)->stepCount() > 0);
  }
}

CHAINMAIL_TEST(DocumentChangesTest)

}  // namespace chainmail::test_document_changes

#include "document_changes.moc"
