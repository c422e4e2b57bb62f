// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/request.hpp"

#include "proto/base/document.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/text.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

namespace hapnet::ctl {

namespace {

/// Adds the files that laws name at any place of a document: { law = "trace", file = "delays.csv"
/// }.
void add_names(const base::Node& node, std::set<std::string>& names)
{
    if (const auto* list = std::get_if<base::Node::List>(&node.value)) {
        for (const base::Node& one : *list) add_names(one, names);
    }
    const auto* table = std::get_if<base::Node::Table>(&node.value);
    if (table == nullptr) return;
    for (const base::Entry& entry : *table) {
        const auto* text = std::get_if<std::string>(&entry.value.value);
        if (entry.key == "file" && text != nullptr) names.insert(*text);
        add_names(entry.value, names);
    }
}

/// Adds the content of the files with these names, which are in `folder`. If none of them exists,
/// they are meant to be in the folder that the emulator reads.
base::Result<void> add_files(const std::set<std::string>& names,
                             const std::filesystem::path& folder, nlohmann::ordered_json& request)
{
    std::error_code error;
    const auto is_here = [&](const std::string& name) {
        return std::filesystem::exists(folder / name, error);
    };
    if (std::none_of(names.begin(), names.end(), is_here)) return {};
    for (const std::string& name : names) {
        auto text = net::text_of_file((folder / name).string());
        if (!text) return tl::unexpected{text.error()};
        request["files"][name] = *std::move(text);
    }
    return {};
}

/// Adds the profile: its text with its files, or a name that only the emulator can resolve.
base::Result<void> add_profile(const std::string& file, nlohmann::ordered_json& request)
{
    const bool is_input = file == "-";
    const bool can_be_preset = file.find('/') == std::string::npos && !file.ends_with(".toml");
    if (!is_input && can_be_preset && !std::filesystem::exists(file)) {
        request["preset"] = file;
        return {};
    }
    base::Result<std::string> text = is_input
                                         ? std::string{std::istreambuf_iterator<char>{std::cin}, {}}
                                         : net::text_of_file(file);
    if (!text) return tl::unexpected{text.error()};
    std::set<std::string> names;
    if (const auto document = base::parse_document(*text)) add_names(*document, names);
    request["profile"] = *std::move(text);
    request["file"] = is_input ? "(standard input)" : file;
    // Files that a profile names are in the folder of the profile.
    return add_files(names, is_input ? "" : std::filesystem::path{file}.parent_path(), request);
}

/// Adds the settings. Files that they name are in the working directory.
base::Result<void> add_settings(const Options& options, nlohmann::ordered_json& request)
{
    std::set<std::string> names;
    for (const auto& [key, value] : options.settings) {
        request["settings"][key] = value;
        if (const auto node = base::parse_option(value, false)) add_names(*node, names);
    }
    return add_files(names, "", request);
}

} // namespace

base::Result<nlohmann::ordered_json> make_request(const Options& options)
{
    nlohmann::ordered_json request{{"command", options.command}};
    const auto add = [&](const char* key, const std::optional<base::Duration>& time) {
        if (time) request[key] = base::to_text(*time);
    };
    if (const auto added = add_settings(options, request); !added) {
        return tl::unexpected{added.error()};
    }
    if (!options.file.empty()) {
        const auto added = add_profile(options.file, request);
        if (!added) return tl::unexpected{added.error()};
    }
    if (!options.until.empty()) request["until"] = options.until;
    if (!options.name.empty()) request["name"] = options.name;
    add("last", options.last);
    add("for", options.lasting);
    add("timeout", options.timeout);
    add("every", options.every);
    if (options.of_frames) request["what"] = "frames";
    return request;
}

} // namespace hapnet::ctl
