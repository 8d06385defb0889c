// A document's parameters: softness, relaxation, and what methods of elasticity go by.

#include "common/text.h"
#include "document/document.h"
#include "document/edits.h"

namespace chainmail {

void Document::setSoftness(const LinkSoftness& global, const QString& text, int gesture) {
  if (global != softness_->global) {
    pushSoftness({global, softness_->links}, text, gesture);
  }
}

void Document::setSoftnessOf(const std::vector<LinkId>& links, const std::optional<LinkSoftness>& own) {
  Softness softness = *softness_;
  for (const LinkId link : links) {
    if (own) {
      softness.links.insert_or_assign(link, *own);
    } else {
      softness.links.erase(link);
    }
  }
  if (softness.links != softness_->links) {
    pushSoftness(std::move(softness), counted(QStringLiteral("stiffness of"), links.size(), QStringLiteral("link")), 0);
  }
}

void Document::resetSoftness() {
  if (*softness_ != Softness()) {
    pushSoftness({}, QStringLiteral("reset stiffness"), 0);
  }
}

void Document::pushSoftness(Softness softness, const QString& text, int gesture) {
  push(new SoftnessEdit(*this, std::make_shared<const Softness>(std::move(softness)), text, gesture));
}

void Document::setRelaxation(const commands::SetRelaxation& relaxation, int gesture) {
  if (relaxation != relaxation_) {
    const QString text = relaxation.on == relaxation_.on ? QStringLiteral("relaxation's settings")
                         : relaxation.on                 ? QStringLiteral("relaxation on")
                                                         : QStringLiteral("relaxation off");
    push(new RelaxationEdit(*this, relaxation, text, gesture));
  }
}

void Document::showRelaxation(const commands::SetRelaxation& relaxation) {
  relaxation_ = relaxation;
  emit relaxationChanged();
}

void Document::setElastic(const ElasticOptions& options, const QString& text, int gesture) {
  if (options != elastic_) {
    push(new ElasticEdit(*this, options, text, gesture));
  }
}

void Document::showElastic(const ElasticOptions& options) {
  elastic_ = options;
  emit elasticChanged();
}

void Document::setSoftnessAndRelaxation(const LinkSoftness& global, const commands::SetRelaxation& relaxation,
                                        const QString& text) {
  if (global == softness_->global && relaxation == relaxation_) {
    return;
  }
  endDrag();  // a step of its own
  undoStack_.beginMacro(text);
  setSoftness(global, text);
  setRelaxation(relaxation);
  undoStack_.endMacro();
}

void Document::showSoftness(std::shared_ptr<const Softness> softness) {
  softness_ = std::move(softness);
  emit softnessChanged();
}

}  // namespace chainmail
