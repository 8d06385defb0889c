#pragma once

#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "document/change.h"
#include "mesh/split.h"

namespace chainmail {
class Document;
}

/// Edits of a document. Each is one undo step; a value that stays the same adds none. Steps with the same `gesture`
/// (not 0) and text become one.
namespace chainmail::edits {

void setSoftness(Document& document, const LinkSoftness& global, const QString& text, int gesture = 0);
void setEnergy(Document& document, EnergyKind kind);
/// Sets the axes along which valid regions lie: those of the world, or the principal axes of the object.
void setRegionAxes(Document& document, AxesKind kind);
/// Sets the softness of these links. If `own` is empty, the global softness applies to them again.
void setSoftnessOf(Document& document, const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own);
/// Resets all links to the softness of a new object, including links with a softness of their own.
void resetSoftness(Document& document);
void setRelaxation(Document& document, const commands::SetRelaxation& relaxation, int gesture = 0);
/// Relaxation to the material is on: the energy, the scheme, and regions that hardly bind.
void relaxToMaterial(Document& document);
/// True if these are set, whether relaxation is on or not.
bool isRelaxedToMaterial(const Document& document);
/// The document emits refused() if the options contradict each other.
void setElastic(Document& document, const ElasticOptions& options, const QString& text, int gesture = 0);
/// Sets the algorithm of a panel. The document emits refused() if the algorithm does not work on the mesh.
void setAlgorithm(Document& document, int panel, Algorithm algorithm);
void setPinned(Document& document, const std::vector<ElementId>& elements, bool pinned);
void cut(Document& document, const std::vector<LinkId>& links);
/// Splits cells or faces of the object, and cuts links of the object before the split.
void split(Document& document, const SplitPointer& split, const std::vector<LinkId>& cut = {});
void resetObject(Document& document);

/// How another object replaces the one of the document: as one undo step; as the first object of a window, which is no
/// undo step; as unsaved work, which is modified from the start.
enum class Opening { next, first, unsaved };
/// Opens another object: a new document, which has no file yet. `own` contains the softness of links that have their
/// own. Throws Error if the window cannot show it, and Cancelled if the user does not want to lose the present work,
/// which could not be kept; nothing has changed then.
void replaceMesh(Document& document, const MeshPointer& mesh, const QString& name, const QString& text,
                 Opening opening = Opening::next, OwnSoftness own = {});
/// Replaces the mesh of the same object, for example with a repaired one. Otherwise as replaceMesh().
void reworkMesh(Document& document, const MeshPointer& mesh, const QString& name, const QString& text,
                OwnSoftness own = {});
/// Opens a session, as replaceMesh() opens a mesh, in as many panels as it has. A panel that it does not have shows the
/// object of its first panel and keeps its algorithm if possible.
void restore(Document& document, const std::shared_ptr<const Session>& session, const QString& file,
             const QString& text, Opening opening = Opening::next);

}  // namespace chainmail::edits
