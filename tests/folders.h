#pragma once

#include <QString>
#include <filesystem>

namespace chainmail {

/// Paths in the source and in this build; `path` is relative to the root of either, without a slash at its end. Only
/// folders.cpp is compiled with the folders, so that ccache finds the other objects in each checkout.
std::filesystem::path source_file(const char* path = "");
QString sourceFile(const char* path = "");
QString builtFile(const char* path);

}  // namespace chainmail
