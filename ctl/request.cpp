// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/request.hpp"

#include "proto/base/text.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>

namespace hapnet::ctl {

namespace {

/// The profile that a request names: its text, or a name that only the emulator can know.
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
    request["profile"] = *std::move(text);
    // What a profile names lies beside it, wherever the emulator was started.
    request["file"] = is_input ? "(standard input)" : std::filesystem::absolute(file).string();
    return {};
}

} // namespace

base::Result<nlohmann::ordered_json> make_request(const Options& options)
{
    nlohmann::ordered_json request{{"command", options.command}};
    const auto add = [&](const char* key, const std::optional<base::Duration>& time) {
        if (time) request[key] = base::to_text(*time);
    };
    for (const auto& [key, value] : options.settings) request["settings"][key] = value;
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
