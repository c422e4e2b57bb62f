// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/request.hpp"

#include "proto/base/text.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <iostream>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::ctl {

namespace {

base::Result<std::string> read_profile(const Options& options)
{
    const std::string& file = options.file;
    if (file == "-") return std::string{std::istreambuf_iterator<char>{std::cin}, {}};
    auto text = net::text_of_file(file);
    if (text || file.find('/') != std::string::npos || file.ends_with(".toml")) return text;
    // The presets are the emulator's.
    return base::fail(fmt::format("{0}; for the preset of that name: hapnet-emulator check "
                                  "{1} | hapnet-ctl {2} {3} -",
                                  text.error().message, file, options.socket, options.command));
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
        auto text = read_profile(options);
        if (!text) return tl::unexpected{text.error()};
        request["profile"] = *std::move(text);
        // What a profile names lies beside it, wherever the emulator was started.
        request["file"] = options.file == "-" ? "(standard input)"
                                              : std::filesystem::absolute(options.file).string();
    }
    if (!options.until.empty()) request["until"] = options.until;
    add("for", options.lasting);
    add("timeout", options.timeout);
    add("every", options.every);
    return request;
}

} // namespace hapnet::ctl
