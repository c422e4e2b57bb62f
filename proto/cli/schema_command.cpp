// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/schema_command.hpp"

#include "proto/base/reading.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::cli {

SchemaCommand::SchemaCommand(Command& program, std::vector<DocumentSchema> documents)
    : documents_{std::move(documents)},
      command_{&program.command("schema", "Prints the JSON Schema of what the program prints")}
{
    std::ranges::sort(documents_, {}, &DocumentSchema::name);
    command_->describe("Prints the JSON Schema (draft 2020-12) of a kind of document that the "
                       "program prints or writes. Without a name: the names, and what documents "
                       "they are of.");
    command_->flag("--list", "Print the names, and what documents they are of", lists_);
    command_->positional("NAME", "The kind of document",
                         [this](const std::string& name) -> base::Result<void> {
                             std::vector<std::string_view> names;
                             for (const DocumentSchema& one : documents_) {
                                 if (one.name == name) chosen_ = names.size();
                                 names.push_back(one.name);
                             }
                             if (chosen_) return {};
                             return base::fail(fmt::format("there is no schema of this name: {}",
                                                           base::suggestion(name, names)));
                         });
}

std::string SchemaCommand::text() const
{
    if (chosen_ && !lists_) return documents_[*chosen_].text();
    std::string list;
    for (const DocumentSchema& one : documents_) {
        const auto schema = nlohmann::json::parse(one.text());
        list += fmt::format("{:<12} {}\n", one.name, schema.at("title").get<std::string>());
    }
    return list;
}

} // namespace hapnet::cli
