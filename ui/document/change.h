#pragma once

#include <QString>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mesh/parts.h"
#include "simulate/command.h"

namespace chainmail {

/// The object of a document without its positions. Cuts and pins change in place, so that a change costs its own size
/// and not the size of the object.
struct DocumentObject {
  DocumentObject(MeshPointer shown, QString called)
      : mesh(std::move(shown)), name(std::move(called)), cuts(mesh), parts(mesh) {}

  MeshPointer mesh;
  QString name;
  Cuts cuts;
  Parts parts;                  // of the object with these cuts
  std::vector<ElementId> pins;  // ascending
};

/// The values that undo brings back. Positions are not among them: each solver keeps its own. A copy copies pointers,
/// not elements or links.
struct Contents {
  static constexpr int mostPanels = 4;

  std::shared_ptr<DocumentObject> object;
  std::shared_ptr<const Softness> softness = std::make_shared<const Softness>();
  commands::SetRelaxation relaxation;
  ElasticOptions elastic;
  int panels = 0;
  std::array<Algorithm, mostPanels> algorithms{};  // one per panel; of a removed panel the last one
};

/// One step of undo, as data: Document::apply carries it out.
///
/// To write an edit, start with Document::change(text), replace the values in `after`, and apply it. The document sends
/// the solvers the commands for all values that differ, and emits their signals. Undo shows the values from before.
struct Change {
  QString text;                        // in the undo list, for example "cut 3 links"
  Contents after;                      // with the change done
  int gesture = 0;                     // changes of one gesture (not 0) with the same text become one step of undo
  std::vector<LinkId> cut;             // links that the change cuts
  std::vector<ElementId> pin, unpin;   // elements that the change pins and unpins, ascending
  std::optional<QString> sessionFile;  // another session file; after that the previous one
  std::function<void()> carryOut;      // sends the solvers what the values do not say; called once
  bool followsTape = false;            // cuts, pins and softness become what the tape says
};

}  // namespace chainmail
