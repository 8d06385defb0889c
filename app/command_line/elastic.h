#pragma once

#include "command_line/common.h"
#include "elastic/material.h"

namespace chainmail::command_line {

/// What methods of elasticity and free-form deformation go by, as options.
struct ElasticArguments {
  CLI::Option *young = nullptr, *poisson = nullptr, *lattice = nullptr;
};
ElasticArguments add_elastic(CLI::App& app);
/// Throws Error, naming the option, where they are out of range.
ElasticOptions elastic_of(const ElasticArguments& arguments);

/// The elements that a word names to be pinned: `boundary`, or a layer as `bottom`. Nothing where it is no such word.
/// Throws Error, naming the option, where the object has none.
std::optional<std::vector<ElementId>> pins_by_name(const std::string& where, const std::string& word, const Mesh& mesh);
/// All such words, as a help text parts them.
std::string pin_names();

}  // namespace chainmail::command_line
