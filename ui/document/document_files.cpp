#include "document/document_files.h"

#include <utility>

#include "common/application.h"

namespace chainmail {

void DocumentFiles::setSession(const QString& file) {
  if (file != session_) {
    session_ = file;
    emit sessionChanged();
  }
}

void DocumentFiles::exchangeSession(QString& file) {
  std::swap(session_, file);
  Application::guarded([this] { emit sessionChanged(); });
}

}  // namespace chainmail
