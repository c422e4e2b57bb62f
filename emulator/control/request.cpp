// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/request.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using control::Members;

/// The least interval between two frames of a watch. A round of the relay can bear the work for it.
constexpr base::Duration frames_least = 20ms;

std::vector<SettingText> settings_of(Members& members)
{
    std::vector<SettingText> settings;
    const auto* value = members.find("settings");
    if (value == nullptr || !value->is_object() || value->empty()) {
        members.fail("\"settings\" must be an object such as {\"both.delay\":\"80ms\"}");
        return settings;
    }
    if (value->size() > settings_max) {
        members.fail(fmt::format("more than {} settings", settings_max));
    }
    for (const auto& [name, text] : value->items()) {
        if (!text.is_string()) {
            members.fail(fmt::format("the value of \"{}\" must be a string", name));
            break;
        }
        settings.emplace_back(name, text.get<std::string>());
    }
    return settings;
}

SentFiles files_of(Members& members)
{
    const auto* value = members.find("files");
    if (value == nullptr) return std::nullopt;
    std::map<std::string, std::string> files;
    const auto refuse = [&](std::string why) {
        members.fail(std::move(why));
        return SentFiles{};
    };
    if (!value->is_object()) {
        return refuse("\"files\" must be an object such as {\"delays.csv\":\"time,delay\\n...\"}");
    }
    if (value->size() > files_max) return refuse(fmt::format("more than {} files", files_max));
    std::size_t bytes = 0;
    for (const auto& [name, text] : value->items()) {
        if (!text.is_string()) {
            return refuse(fmt::format("the text of the file \"{}\" must be a string", name));
        }
        bytes += text.get_ref<const std::string&>().size();
        files.emplace(name, text.get<std::string>());
    }
    if (bytes > sent_bytes_max) {
        return refuse(fmt::format("the files have {} bytes together; {} may be: copy them into the "
                                  "folder that the emulator reads (--files)",
                                  bytes, sent_bytes_max));
    }
    return files;
}

ProfileText profile_of(Members& members)
{
    if (auto preset = members.optional_text("preset")) return {"", *preset, *preset};
    if (auto netem = members.optional_text("netem")) return {"", "", std::nullopt, *netem};
    auto toml = members.text("profile");
    return {std::move(toml), members.optional_text("file").value_or("profile")};
}

Request request_of(std::string_view command, Members& members, std::optional<base::Duration> held)
{
    if (command == "set") {
        auto settings = settings_of(members);
        const auto lasting = members.time("for", 1ms);
        return SetRequest{std::move(settings), lasting, files_of(members)};
    }
    if (command == "apply" || command == "diff") {
        auto profile = profile_of(members);
        auto files = files_of(members);
        if (command == "apply") return ApplyRequest{std::move(profile), std::move(files)};
        return DiffRequest{std::move(profile), std::move(files)};
    }
    if (command == "reset") return ResetRequest{};
    if (command == "stats") return StatsRequest{};
    if (command == "metrics") return MetricsRequest{};
    if (command == "stop") return StopRequest{};
    if (command == "wait") return control::wait_request(members);
    if (command == "keep") return control::keep_request(members, held);
    if (command == "watch") return control::watch_request(members, frames_least);
    return ShowRequest{};
}

} // namespace

base::Result<Request> parse_request(std::string_view line, std::optional<base::Duration> held)
{
    constexpr std::array<std::string_view, 11> commands{"show",  "set",   "apply",   "diff",
                                                        "reset", "stats", "metrics", "wait",
                                                        "watch", "keep",  "stop"};
    const auto json = control::parse_object(line); // keeps the order of the settings
    if (!json) return tl::unexpected{json.error()};
    Members members{*json};
    const std::string command = members.text("command");
    if (members.error()) return base::fail(*members.error());
    if (std::find(commands.begin(), commands.end(), command) == commands.end()) {
        if (command == "estop") {
            return base::fail("an emulator has no emergency stop, as it moves no device: use stop");
        }
        return base::fail(fmt::format("\"command\" must be one of {}", fmt::join(commands, ", ")));
    }
    return members.finish(request_of(command, members, held));
}

} // namespace hapnet::emulator
