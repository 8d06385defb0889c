#include "document/highlight.h"

#include "common/application.h"

namespace chainmail {

void Highlight::set(const Marks& marks) {
  if (marks != marks_) {
    marks_ = marks;
    Application::guarded([this] { emit changed(); });
  }
}

void Highlight::add(std::span<const LinkId> links) {
  if (!links.empty()) {
    marks_.links.insert(marks_.links.end(), links.begin(), links.end());
    emit changed();
  }
}

}  // namespace chainmail
