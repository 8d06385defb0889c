#pragma once

#include "document/edits.h"
#include "files/session/session.h"

namespace chainmail {

/// Takes up a session: another object with its cuts, pins, softness and relaxation, and in each panel an algorithm and
/// where the elements stand. Panels that the session does not have show its first one's object, by their own algorithm.
class SessionEdit : public Edit {
 public:
  SessionEdit(Document& document, const std::shared_ptr<const Session>& session, const QString& file,
              const QString& text);

 private:
  /// What a document has of its own.
  struct Contents {
    MeshPointer mesh;
    QString name, file;
    Cuts cuts;
    Parts parts;
    std::vector<ElementId> pins;
    std::shared_ptr<const Softness> softness;
    commands::SetRelaxation relaxation;
    ElasticOptions elastic;
    std::vector<Algorithm> algorithms;
  };

  void carryOut() override;
  void prepare(bool done) override;
  void show(bool done) override;
  int count() const;
  void takeMoves(const std::vector<Command>& object);
  void place(int panel);
  void tell() const;

  Contents other_;                          // what the document does not show at the moment
  std::shared_ptr<const Session> session_;  // until it was taken up
};

}  // namespace chainmail
