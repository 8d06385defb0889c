#include "document/edits.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "body/positions.h"
#include "body/snapshot.h"
#include "common/text.h"
#include "document/document.h"
#include "files/session/session.h"
#include "files/session/softness_presets.h"
#include "mesh/error.h"
#include "mesh/progress.h"

namespace chainmail::edits {
namespace {

/// Throws Error if a coordinate is beyond what the window draws: it has positions in single precision.
void requireDrawable(const Mesh& mesh) {
  const double farthest = std::max(mesh.box[0].cwiseAbs().maxCoeff(), mesh.box[1].cwiseAbs().maxCoeff());
  if (const double limit = position_limit(Precision::single_precision); farthest > limit) {
    throw Error("coordinates",
                "they extend to " + QString::number(farthest, 'g', 2).toStdString() + ", and the window draws up to " +
                    QString::number(limit, 'g', 2).toStdString(),
                "scale the object down, or use the command line");
  }
}
void requireDrawable(const Session& session) {
  requireDrawable(*session.mesh);
  for (const Session::Panel& panel : session.panels) {
    // As positions in single precision, whatever their precision is.
    check(panel.positions, *session.mesh, Precision::single_precision);
  }
}

/// Returns the user's settings: during a lesson, those from before it.
std::shared_ptr<const Settings> ownSettings(const Contents& contents) {
  return contents.object->before ? contents.object->before : std::make_shared<const Settings>(contents);
}

/// The object after a lesson gets the user's settings, not those of the lesson.
void takeOwnSettings(Contents& after) {
  const auto own = ownSettings(after);
  after.softness = own->softness;
  after.relaxation = own->relaxation;
  after.elastic = own->elastic;
  std::copy_n(own->algorithms.begin(), std::min(own->panels, after.panels), after.algorithms.begin());
}

Change meshChange(Document& document, const MeshPointer& mesh, const QString& name, const QString& text,
                  OwnSoftness own) {
  Change edit = document.change(text);
  takeOwnSettings(edit.after);
  edit.after.object = std::make_shared<DocumentObject>(ObjectState{mesh}, name);
  edit.after.lesson = {};
  Softness kept = kept_for(*mesh, *edit.after.softness);
  kept.links = std::move(own);
  if (kept != *edit.after.softness) {
    edit.after.softness = std::make_shared<const Softness>(std::move(kept));
  }
  return edit;
}

/// The only place where another object replaces the one of the document: whoever may keep unsaved work is asked first.
void replace(Document& document, const std::function<Change()>& edit, Opening opening) {
  if (!document.keepsWork()) {
    throw Cancelled();
  }
  document.apply(edit());
  QUndoStack& steps = document.undoStack();
  if (opening == Opening::first) {
    steps.clear();
  }
  if (opening != Opening::unsaved) {  // else Undo returns to a state that is as clean as before
    steps.setClean();
  }
}

/// Shows as many panels as the session has, within the limits of the window.
void showPanels(Document& document, const Session& session) {
  const int wanted = std::clamp(int(session.panels.size()), Document::minPanels, Document::maxPanels);
  while (document.panels() < wanted) {
    document.addPanel();
  }
  while (document.panels() > wanted) {
    document.removePanel();
  }
}

/// Loads the moves and the positions of a session. The solvers already have its object. Relaxation sleeps after the
/// positions, so it begins anew if it is on.
void placeSession(Document& document, const std::shared_ptr<const Session>& session) {
  document.moves().open(*session);
  for (int panel = 0; panel < document.panels(); ++panel) {
    const auto& saved = session->panels;
    const auto& from = std::size_t(panel) < saved.size() ? saved[std::size_t(panel)] : saved.front();
    // The pointer shares the session instead of copying its numbers.
    document.solvers().post(panel, commands::SetPositions{std::shared_ptr<const Snapshot>(session, &from.positions)});
  }
  if (commands::SetRelaxation relaxation = session->relaxation; relaxation.on) {
    relaxation.anew = true;
    document.solvers().log().replay(relaxation);
  }
}

/// Returns the first of the steps that end at or just before a position in the moves.
std::size_t stepAt(const Lesson& lesson, std::size_t position) {
  const auto& steps = lesson.steps;
  std::size_t step = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    step = steps[i].until <= position && steps[i].until > steps[step].until ? i : step;
  }
  return step;
}

Change sessionChange(Document& document, const std::shared_ptr<const Session>& session, const QString& file,
                     const QString& text) {
  Change edit = document.change(text);
  auto object = std::make_shared<DocumentObject>(*session, QString::fromStdString(session->name));
  edit.after.lesson = {};
  if (!session->lesson.steps.empty()) {
    edit.after.lesson = {session, std::shared_ptr<const Lesson>(session, &session->lesson),
                         stepAt(session->lesson, session->moves_done)};
    object->before = ownSettings(edit.after);
  }
  object->unsplit = first_mesh(*session);
  edit.after.object = std::move(object);
  edit.after.softness = session->softness;
  edit.after.relaxation = session->relaxation;
  edit.after.elastic = session->elastic;
  for (std::size_t panel = 0; panel < std::size_t(document.panels()); ++panel) {
    Algorithm& algorithm = edit.after.algorithms[panel];
    algorithm = panel < session->panels.size()    ? session->panels[panel].algorithm
                : fits(algorithm, *session->mesh) ? algorithm
                                                  : Algorithm::natural_queue;
  }
  edit.sessionFile = file;
  edit.carryOut = [&document, session] { placeSession(document, session); };
  return edit;
}

}  // namespace

void setSoftness(Document& document, const LinkSoftness& global, const QString& text, int gesture) {
  if (global != document.softness()) {
    Change edit = document.change(text, gesture);
    edit.after.softness = std::make_shared<const Softness>(Softness{
        global, document.wholeSoftness()->links, document.wholeSoftness()->energy, document.wholeSoftness()->axes});
    document.apply(std::move(edit));
  }
}

void setRegionAxes(Document& document, AxesKind kind) {
  const RegionAxes axes = kind == AxesKind::object ? principal_axes(*document.mesh()).axes : RegionAxes();
  if (kind != AxesKind::given && axes != document.wholeSoftness()->axes) {
    Softness softness = *document.wholeSoftness();
    softness.axes = axes;
    Change edit = document.change(kind == AxesKind::object ? QStringLiteral("regions along the object's axes")
                                                           : QStringLiteral("regions along the axes"));
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
    document.apply(std::move(edit));
  }
}

void setEnergy(Document& document, EnergyKind kind) {
  if (kind != document.wholeSoftness()->energy) {
    Softness softness = *document.wholeSoftness();
    set_energy(softness, kind);
    Change edit = document.change(QString::fromStdString(std::string(info(kind).name)) + QStringLiteral(" energy"));
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
    document.apply(std::move(edit));
  }
}

void setSoftnessOf(Document& document, const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own) {
  Softness softness = *document.wholeSoftness();
  own ? softness.links.set(links, *own) : softness.links.erase(links);
  if (softness.links != document.wholeSoftness()->links) {
    Change edit = document.change(counted(QStringLiteral("softness of"), links.size(), QStringLiteral("link")));
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
    document.apply(std::move(edit));
  }
}

void resetSoftness(Document& document) {
  if (*document.wholeSoftness() != standard_softness()) {
    Change edit = document.change(QStringLiteral("reset softness"));
    edit.after.softness = std::make_shared<const Softness>(standard_softness());
    document.apply(std::move(edit));
  }
}

void setRelaxation(Document& document, const commands::SetRelaxation& relaxation, int gesture) {
  const commands::SetRelaxation& present = document.relaxation();
  if (relaxation != present) {
    Change edit = document.change(relaxation.on == present.on ? QStringLiteral("relaxation settings")
                                  : relaxation.on             ? QStringLiteral("relaxation on")
                                                              : QStringLiteral("relaxation off"),
                                  gesture);
    edit.after.relaxation = relaxation;
    document.apply(std::move(edit));
  }
}

bool isRelaxedToMaterial(const Document& document) {
  return document.wholeSoftness()->energy == EnergyKind::material && document.softness() == open_regions &&
         document.relaxation().scheme == RelaxationScheme::equilibrium;
}

void relaxToMaterial(Document& document) {
  Softness softness = *document.wholeSoftness();
  softness.global = open_regions;
  softness.energy = EnergyKind::material;
  Change edit = document.change(QStringLiteral("relaxation to the material"));
  if (softness != *document.wholeSoftness()) {
    edit.after.softness = std::make_shared<const Softness>(std::move(softness));
  }
  edit.after.relaxation.on = true;
  edit.after.relaxation.scheme = RelaxationScheme::equilibrium;
  document.apply(std::move(edit));
}

void setElastic(Document& document, const ElasticOptions& options, const QString& text, int gesture) {
  try {
    check(options);
  } catch (const Error& error) {
    emit document.refused(QString::fromStdString(error.what()));
    emit document.elasticChanged();  // so that fields show the present values again
    return;
  }
  if (options != document.elastic()) {
    Change edit = document.change(text, gesture);
    edit.after.elastic = options;
    document.apply(std::move(edit));
  }
}

void setAlgorithm(Document& document, int panel, Algorithm algorithm) {
  try {
    check(algorithm, *document.mesh());
  } catch (const Error& error) {
    emit document.refused(QString::fromStdString(error.what()));
    emit document.algorithmChanged(panel);  // so that selectors show the running algorithm again
    return;
  }
  if (document.algorithm(panel) != algorithm) {
    Change edit = document.change(chainmail::text(info(algorithm).label));
    edit.after.algorithms[std::size_t(panel)] = algorithm;
    document.apply(std::move(edit));
  }
}

void setPinned(Document& document, const std::vector<ElementId>& elements, bool pinned) {
  if (!elements.empty()) {
    Change edit = document.change(
        counted(pinned ? QStringLiteral("pin") : QStringLiteral("unpin"), elements.size(), QStringLiteral("element")));
    (pinned ? edit.pin : edit.unpin) = elements;
    document.apply(std::move(edit));
  }
}

void cut(Document& document, const std::vector<LinkId>& links) {
  if (!links.empty()) {
    Change edit = document.change(counted(QStringLiteral("cut"), links.size(), QStringLiteral("link")));
    edit.cut = links;
    document.apply(std::move(edit));
  }
}

void split(Document& document, const SplitPointer& split, const std::vector<LinkId>& cut) {
  Change edit = document.change(QStringLiteral("cut along a stroke"));
  ObjectState after = object_after(*split, document.object());
  std::vector<LinkId>& all = after.cuts;
  std::ranges::set_difference(cuts_after(*split, cut), all, std::back_inserter(edit.cut));
  const auto old = all.insert(all.end(), edit.cut.begin(), edit.cut.end());
  std::inplace_merge(all.begin(), old, all.end());
  edit.after.goTo(after);
  edit.split = split;
  document.apply(std::move(edit));
}

void resetObject(Document& document) {
  document.moves().endSweeps();
  Change edit = document.change(QStringLiteral("reset object"));
  edit.resets = true;
  document.apply(std::move(edit));
}

void replaceMesh(Document& document, const MeshPointer& mesh, const QString& name, const QString& text, Opening opening,
                 OwnSoftness own) {
  requireDrawable(*mesh);
  replace(
      document,
      [&] {
        Change edit = meshChange(document, mesh, name, text, std::move(own));
        edit.sessionFile = QString();
        return edit;
      },
      opening);
}

void reworkMesh(Document& document, const MeshPointer& mesh, const QString& name, const QString& text,
                OwnSoftness own) {
  requireDrawable(*mesh);
  document.apply(meshChange(document, mesh, name, text, std::move(own)));
}

void restore(Document& document, const std::shared_ptr<const Session>& session, const QString& file,
             const QString& text, Opening opening) {
  requireDrawable(*session);
  replace(
      document,
      [&] {
        showPanels(document, *session);
        return sessionChange(document, session, file, text);
      },
      opening);
}

}  // namespace chainmail::edits
