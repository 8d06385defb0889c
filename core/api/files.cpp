#include "chainmail/files.h"

#include <utility>

#include "api/access.h"
#include "files/text/outputs.h"
#include "files/text/temporary_folder.h"

namespace chainmail::api {

struct Outputs::Impl {
  inner::Outputs outputs;
};

Outputs::Outputs() : impl_(std::make_unique<Impl>()) {}
Outputs::~Outputs() = default;

void Outputs::keep(const std::filesystem::path& input) {
  guarded([&] { impl_->outputs.keep(input); });
}
void Outputs::add(const std::filesystem::path& path, Writer writer) {
  guarded([&] { impl_->outputs.add(path, std::move(writer)); });
}
void Outputs::commit() {
  guarded([&] { impl_->outputs.commit(); });
}

void write_file(const std::filesystem::path& path, const Outputs::Writer& writer) {
  guarded([&] { inner::write_file(path, writer); });
}

void remove_folders_on_signals() { inner::remove_folders_on_signals(); }

}  // namespace chainmail::api
