// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::cli {

/// A kind of document that a program prints or writes, and its JSON Schema.
struct DocumentSchema {
    std::string_view name;           // the NAME in `schema NAME`
    std::string_view written;        // text of the schema if `make` is nullptr
    std::string (*make)() = nullptr; // generates the schema from a struct (proto/output/schema.hpp)

    [[nodiscard]] std::string text() const
    {
        return make != nullptr ? make() : std::string{written};
    }
};

/// The command `schema [--list | NAME]`, which every program that prints JSON has.
class SchemaCommand {
public:
    SchemaCommand(Command& program, std::vector<DocumentSchema> documents);
    SchemaCommand(const SchemaCommand&) = delete;
    SchemaCommand& operator=(const SchemaCommand&) = delete;
    ~SchemaCommand() = default;

    [[nodiscard]] bool is_chosen() const { return command_->is_chosen(); }
    /// Returns the text to print: the schema, or the names and titles of all schemas.
    [[nodiscard]] std::string text() const;

private:
    std::vector<DocumentSchema> documents_; // in the order of their names
    Command* command_;
    std::optional<std::size_t> chosen_;
    bool lists_ = false;
};

} // namespace hapnet::cli
