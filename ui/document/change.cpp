#include "document/change.h"

#include <utility>

namespace chainmail {

std::shared_ptr<DocumentObject> withMesh(const DocumentObject& object, const MeshPointer& mesh,
                                         const std::vector<LinkId>& cuts, std::vector<ElementId> pins) {
  auto result = std::make_shared<DocumentObject>(mesh, object.name);
  result->unsplit = object.unsplit;
  result->before = object.before;
  result->parts.cut(result->cuts, cuts);
  result->pins = std::move(pins);
  return result;
}

}  // namespace chainmail
